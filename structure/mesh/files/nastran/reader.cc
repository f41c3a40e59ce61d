// Nastran bulk data: the order of reading, and what is left out.

#include "structure/mesh/files/nastran/reader.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "structure/mesh/files/deck/surface_points.h"
#include "structure/mesh/files/nastran/model.h"

namespace blocklift::structure {

namespace {

/// Cards that some stage reads.
const std::set<std::string, std::less<>>& cards_read() {
  static const std::set<std::string, std::less<>> names{
      "GRID",   "GRDSET", "CORD1R", "CORD1C",  "CORD1S",  "CORD2R",  "CORD2C",  "CORD2S", "PARAM",
      "CQUAD4", "CQUAD8", "CQUADR", "CTRIA3",  "CTRIA6",  "CTRIAR",  "CBAR",    "CBEAM",  "CROD",
      "CTUBE",  "CONROD", "CBUSH",  "CELAS1",  "CELAS2",  "CONM1",   "CONM2",   "RBE1",   "RBE2",
      "RBE3",   "RBAR",   "RROD",   "RTRPLT",  "RJOINT",  "CMASS1",  "CMASS2",  "PMASS",  "NSM",
      "NSM1",   "NSML",   "NSML1",  "NSMADD",  "PSHELL",  "PCOMP",   "PCOMPG",  "PBAR",   "PBARL",
      "PBEAM",  "PBEAML", "PROD",   "PTUBE",   "PBUSH",   "PELAS",   "MAT1",    "MAT2",   "MAT8",
      "MAT9",   "MAT11",  "CPYRAM", "BAROR",   "BEAMOR",  "SPC",     "SPC1",    "SPCADD", "MPC",
      "MPCADD", "FORCE",  "FORCE1", "FORCE2",  "MOMENT",  "MOMENT1", "MOMENT2", "LOAD",   "GRAV",
      "RFORCE", "PLOAD",  "PLOAD1", "PLOAD2",  "PLOAD4",  "INCLUDE", "CHEXA",   "CPENTA", "CTETRA",
      "PSOLID", "CSHEAR", "PSHEAR", "RSPLINE", "CBUSH1D", "PBUSH1D", "SPCD",    "TEMP",   "TEMPD",
      "TEMPP1", "TEMPRB"};
  return names;
}

struct Reason {
  const char* text;
  std::vector<std::string_view> names;
  bool has_loads = false;
};

/// Cards that change nothing in what a block of plates and beams weighs or how it bears a load
/// given otherwise.
const std::vector<Reason>& reasons() {
  static const std::vector<Reason> all{
      {"aeroelasticity has no meaning here",
       {"AEROS",   "AERO",    "AESTAT",  "AESURF",  "AESURFS", "AELIST",  "AELINK",  "AECOMP",
        "AECOMPL", "AEPARM",  "AEFACT",  "AEFORCE", "AEPRESS", "CAERO1",  "CAERO2",  "CAERO3",
        "CAERO4",  "CAERO5",  "PAERO1",  "PAERO2",  "PAERO3",  "PAERO4",  "PAERO5",  "SPLINE1",
        "SPLINE2", "SPLINE3", "SPLINE4", "SPLINE5", "SPLINE6", "SPLINE7", "SET1",    "SET2",
        "SET3",    "TRIM",    "TRIM2",   "FLUTTER", "FLFACT",  "MKAERO1", "MKAERO2", "GUST",
        "MONPNT1", "MONPNT2", "MONPNT3", "MONDSP1", "DIVERG",  "CSSCHD",  "UXVEC",   "AEPRESS",
        "AEGRID",  "AEQUAD4", "AETRIA3", "PANLST1", "PANLST2", "PANLST3", "MONCNCM", "MONSUM",
        "MONSUM1", "MONGRP",  "MONDSP2", "SPLINEX", "SPLINRB", "RVDOF",   "SPBLND1", "SPBLND2",
        "SPRELAX"}},
      {"optimisation has no meaning here",
       {"DESVAR", "DVPREL1", "DVPREL2", "DVMREL1", "DVMREL2", "DVCREL1", "DVCREL2", "DRESP1",
        "DRESP2", "DRESP3",  "DCONSTR", "DCONADD", "DOPTPRM", "DLINK",   "DEQATN",  "DSCREEN",
        "TOPVAR", "DVGRID",  "DVSHAP",  "DVBSHAP", "DTABLE",  "DDVAL",   "BEADVAR", "DSELOPT",
        "DESGLB", "DTABLE2", "TOMVAR",  "DVLREL1", "DVPSURF", "DVTREL1", "STOCHAS", "DSELECT"}},
      {"drawing alone",
       {"PLOTEL", "PLOTEL3", "PLOTEL4", "PLOTEL6", "PLOTEL8", "PLOTHEX", "PLOTPEN", "PLOTTET",
        "PLOTPYR"}},
      {"dynamics of the deck's own: the lift gives the motion",
       {"CDAMP3", "CDAMP4",  "CDAMP5", "PDAMP5",  "PDAMPT",  "PELAST",  "PBUSHT",  "TABDMP1",
        "EIGRL",  "EIGR",    "EIGB",   "EIGC",    "EIGP",    "TSTEP",   "TSTEPNL", "FREQ",
        "FREQ1",  "FREQ2",   "FREQ3",  "FREQ4",   "FREQ5",   "TLOAD1",  "TLOAD2",  "RLOAD1",
        "RLOAD2", "DAREA",   "DLOAD",  "TABLED1", "TABLED2", "TABLED3", "TABLED4", "DPHASE",
        "DELAY",  "RANDPS",  "RANDT1", "TABRND1", "TIC",     "TABLEM1", "TABLEM2", "DYNRED",
        "RSPECI", "PVISC",   "CVISC",  "CDAMP1",  "CDAMP2",  "PDAMP",   "NLPARM",  "NLPCI",
        "NLSTEP", "TABLES1", "MATS1",  "SUPORT",  "SUPORT1", "RCROSS",  "ROTORG",  "ROTOR",
        "ROTORD", "RGYRO",   "RSPINR", "RSPINT",  "UNBALNC", "ACSRCE",  "NOLIN1",  "NOLIN2",
        "NOLIN3", "NOLIN4",  "TF",     "TSTEP1",  "NLADAPT", "NLAUTO",  "TABDMP2", "CDAMP1D"}},
      {"temperatures that are not read: cases that ask for these sets are not solved",
       {"TEMPP2", "TEMPP3", "TEMPF", "TEMPN1", "TEMPG", "TEMPB3", "TEMPBC", "TEMPEX"},
       true},
      {"properties at other temperatures: those without a temperature are used",
       {"MATT1", "TABLEST"}},
      {"how heat flows has no meaning here",
       {"MAT4",  "MAT5",   "CHBDYE", "CHBDYG", "CHBDYP", "PCONV",  "CONV",   "QBDY1",
        "QBDY2", "QBDY3",  "QVOL",   "RADM",   "RADBC",  "RADSET", "VIEW",   "VIEW3D",
        "PHBDY", "PCONVM", "CONVM",  "BDYOR",  "QHBDY",  "QVECT",  "RADLST", "RADMTX"},
       true},
      {"a load that is not read",
       {"ACCEL", "ACCEL1", "DEFORM", "SLOAD", "PLOADX1", "LSEQ", "PRESAX"},
       true},
      {"which freedoms the solver keeps changes no result",
       {"ASET", "ASET1", "BSET", "BSET1", "CSET", "CSET1", "OMIT", "OMIT1", "QSET", "QSET1", "USET",
        "USET1", "SEQGP"}},
      {"of solids that are not read", {"PLSOLID", "PCOMPS", "MAT3"}},
      {"points without a place, on which nothing of the block hangs",
       {"SPOINT", "EPOINT", "CELAS3", "CELAS4", "CMASS3", "CMASS4"}},
      {"properties and materials of elements that are not known, which are told of themselves",
       {"PBEND",  "PGAP",   "PFAST",  "PWELD",  "PSEAM",  "PBCOMP", "PBMSECT", "PBRSECT", "PLPLANE",
        "PPLANE", "PBEAM3", "PRAC2D", "PRAC3D", "PACBAR", "PACABS", "PAABSF",  "PSHLN1",  "PSHLN2",
        "PSLDN1", "PBARN1", "PBEMN1", "PRODN1", "MAT10",  "MATHP",  "MATHE",   "MATPOR",  "MATF",
        "MATG",   "MATT2",  "MATT3",  "MATT8",  "MATT9",  "MATS3",  "MATS8",   "CREEP"}},
      {"matrices and tables of the solver", {"DMI", "DTI", "DMIJ", "DMIJI", "DMIK", "DMIAX"}},
      {"what is printed, and how the solver goes about it",
       {"STRESS", "BOLTSEQ", "CBARAO", "ECHOON", "ECHOOFF", "HYPERMESH", "MDLPRM", "OUTRCV",
        "OUTPUT", "DEBUG", "SPCOFF", "SPCOFF1", "NXSTRAT", "AUTOSPC", "SYSSET", "DYNOPT",
        "PARAMARN"}},
  };
  return all;
}

/// Cards that there are, that are not known here, and how to say otherwise what they say.
struct Instead {
  const char* text;
  std::vector<std::string_view> names;
};

const std::vector<Instead>& others() {
  static const std::vector<Instead> all{
      {"curved bars are not known; make straight CBAR or CBEAM of each: six to a quarter of a "
       "circle bend as it does within 1.5 %, eight within 1 %",
       {"CBEND"}},
      {"beams of three grids are not known; make two CBEAM of each", {"CBEAM3"}},
      {"what touches or gapes is not known, for a lift is linear; join the parts by CBUSH or RBE2 "
       "where they bear on each other",
       {"CGAP",    "BCTABLE", "BCTABL1", "BCONP",   "BCONPRG", "BCPARA",  "BCTPARA", "BCTPARM",
        "BCTSET",  "BCTADD",  "BCPROP",  "BCPROPS", "BCRPARA", "BCGRID",  "BCBODY",  "BCBODY1",
        "BCBDPRP", "BCSURF",  "BCONECT", "BSURF",   "BSURFS",  "BLSEG",   "BFRIC",   "BWIDTH",
        "BOUTPUT", "BEDGE",   "BGSET",   "BGADD",   "BGPARM",  "CONTACT", "PCONT",   "TIE",
        "GLUE",    "BCAUTOP", "BCHANGE", "BCMATL",  "BCMOVE",  "BCNURBS", "BCPATCH", "BCSEG"}},
      {"spot welds and seams are not known; join the plates by CBUSH, or by RBE2 or RBE3, at each",
       {"CWELD", "CFAST", "CSEAM", "SWLDPRM"}},
      {"bodies of revolution and plane strain cannot be lifted",
       {"CTRIAX",  "CTRIAX6", "CQUADX",  "CQUADX4", "CQUADX8", "CTRAX3",  "CTRAX6",
        "CONEAX",  "CCONEAX", "PCONEAX", "CPLSTN3", "CPLSTN4", "CPLSTN6", "CPLSTN8",
        "CPLSTS3", "CPLSTS4", "CPLSTS6", "CPLSTS8", "AXIC",    "AXIF",    "RINGAX"}},
      {"plates of a hyperelastic material are not known; make CQUAD4 or CQUAD8 of each",
       {"CQUAD", "CTRIA"}},
      {"a stiffness or mass that is given as a matrix is not known; give the parts themselves",
       {"DMIG", "DMIG1", "GENEL", "K2GG", "EXTRN", "CBUSH2D"}},
      {"superelements cannot be lifted; give the deck as one",
       {"CSUPER", "CSUPEXT", "SEBULK", "SECONCT", "SEELT", "SEEXCLD", "SELABEL", "SELOC", "SEMPLN",
        "SESET", "SETREE", "RELEASE"}},
      {"cracks are not known", {"CRAC2D", "CRAC3D"}},
      {"fluids and their panels are not known",
       {"CHACAB", "CHACBR", "CAABSF", "CACINF3", "CACINF4", "CAXIF2", "CAXIF3", "CAXIF4", "CFLUID2",
        "CFLUID3", "CFLUID4", "CSLOT3", "CSLOT4", "MFLUID", "ELIST", "BNDGRID", "FSLIST"}},
      {"a bolt's preload is not known; its bars alone can stand in the deck",
       {"BOLT", "BOLTFOR", "BOLTFRC", "BOLTLD"}},
  };
  return all;
}

/// How to say otherwise what a card says that is not known; empty: there may be no such card.
std::string_view what_instead_of(std::string_view card) {
  for (const Instead& other : others())
    if (std::find(other.names.begin(), other.names.end(), card) != other.names.end())
      return other.text;
  return {};
}

/// All names that may have been meant by one that is not known.
const std::vector<std::string>& all_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all(cards_read().begin(), cards_read().end());
    for (const Reason& reason : reasons())
      all.insert(all.end(), reason.names.begin(), reason.names.end());
    return all;
  }();
  return names;
}

/// Notes numbers of elements, read or not, and of scalar points.
void note_element(NastranModel& model, const NastranCard& card) {
  const CardView view(model.bulk, card);
  if (card.name == "SPOINT" || card.name == "EPOINT") {
    const auto from = to_integer(view.text(0)), to = to_integer(view.text(2));
    if (view.is(1, "THRU") && from && to && *to >= *from) {
      model.scalar_points.emplace_back(*from, *to);
      return;
    }
    for (std::size_t i = 0; i < view.size(); ++i)
      if (const auto label = to_integer(view.text(i)))
        model.scalar_points.emplace_back(*label, *label);
  } else if (card.name.starts_with('C') && !card.name.starts_with("CORD")) {
    if (const auto label = to_integer(view.text(0))) model.any_elements.insert(*label);
  }
}

/// Says where a card of one line has more than its fields.
void remark_on_surplus_fields(NastranModel& model, const NastranCard& card) {
  static const std::map<std::string_view, std::size_t> fields_of{
      {"GRID", 8},    {"FORCE", 7},   {"FORCE1", 5}, {"FORCE2", 7}, {"MOMENT", 7},
      {"MOMENT1", 5}, {"MOMENT2", 7}, {"GRAV", 7},   {"PLOAD", 6},  {"PLOAD1", 8},
      {"SPC", 7},     {"CELAS1", 6},  {"CELAS2", 8}, {"CMASS1", 6}, {"CMASS2", 6},
      {"CROD", 4},    {"CTUBE", 4},   {"CONROD", 8}, {"PROD", 6}};
  const auto known = fields_of.find(card.name);
  if (known == fields_of.end()) return;
  const CardView view(model.bulk, card);
  std::size_t i = known->second;
  while (i < view.size() && !view.has(i)) ++i;
  if (i < view.size())
    model.log.remark(card.line,
                     fmt::format("{}: what it has beyond field {} of its first line is not read, "
                                 "for the card ends there",
                                 card.name, known->second + 1));
}

}  // namespace

bool may_be_nastran_load(std::string_view name) {
  static const std::set<std::string_view> loads{
      "FORCE",  "FORCE1", "FORCE2", "MOMENT", "MOMENT1", "MOMENT2", "GRAV",   "RFORCE", "PLOAD",
      "PLOAD1", "PLOAD2", "PLOAD4", "SPCD",   "TEMP",    "TEMPD",   "TEMPP1", "TEMPRB"};
  if (loads.contains(name)) return true;
  if (cards_read().contains(name) || name.starts_with("TABLE")) return false;
  for (const Reason& reason : reasons())
    if (std::find(reason.names.begin(), reason.names.end(), name) != reason.names.end())
      return reason.has_loads;
  return true;
}

void take_stock_of_nastran_cards(NastranModel& model) {
  std::unordered_map<std::string_view, const char*> left_out;
  for (const Reason& reason : reasons())
    for (const std::string_view name : reason.names) left_out[name] = reason.text;
  for (const NastranCard& card : model.bulk.cards) {
    if (card.name.empty()) continue;  // complained of already
    model.log.read(card.name, card.line);
    note_element(model, card);
    const bool is_solid = card.name == "CHEXA" || card.name == "CPENTA" || card.name == "CTETRA" ||
                          card.name == "CPYRAM";
    if (is_solid && model.options.leave_solids_out) {
      if (const auto label = to_integer(CardView(model.bulk, card).text(0)))
        model.solids.insert(*label);
      model.log.leave_out(card.name, "solids, which were to be left out");
      continue;
    }
    if (card.name == "PSOLID" && model.options.leave_solids_out) {
      model.log.leave_out(card.name, "of solids, which were to be left out");
      continue;
    }
    if (cards_read().count(card.name) > 0) {
      remark_on_surplus_fields(model, card);
      continue;
    }
    if (const auto found = left_out.find(card.name); found != left_out.end())
      model.log.leave_out(card.name, found->second);
    else if (card.name.starts_with("TABLE"))
      model.log.leave_out(card.name, "a table, which says nothing by itself");
    else
      model.log.miss(card.line, card.name, model.options, all_names(), what_instead_of(card.name));
  }
}

Deck read_nastran(const std::filesystem::path& path, const UnitSystem& units,
                  const DeckOptions& options) {
  DeckLog log;
  DeckFiles files(log);
  const NastranBulk bulk = read_nastran_cards(files, path, log);
  Deck deck;
  deck.path = path;
  deck.files = files.paths();
  deck.units = units;
  NastranModel model(bulk, log, deck, options);
  take_stock_of_nastran_cards(model);
  read_nastran_grids(model);
  if (deck.mesh.vertices.empty()) log.complain({}, "the deck has no grids");
  read_nastran_cells(model);
  read_nastran_masses(model);
  read_nastran_shear_panels(model);
  read_nastran_links(model);
  read_nastran_splines(model);
  read_nastran_springs(model);
  read_nastran_cases(model);
  read_nastran_means(model);
  log.check_left_out(options);
  log.check();
  fasten_used_middles(deck, model.middles);
  deck.expansions.of_materials.resize(deck.mesh.materials.size());
  log.hand_over(deck);
  return deck;
}

}  // namespace blocklift::structure
