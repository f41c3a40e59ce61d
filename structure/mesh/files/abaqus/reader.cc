#include "structure/mesh/files/abaqus/reader.h"

#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "structure/mesh/files/abaqus/model.h"
#include "structure/mesh/files/abaqus/parameters.h"
#include "structure/mesh/files/deck/surface_points.h"

namespace blocklift::structure {

namespace {

/// Keywords that some stage reads.
const std::set<std::string, std::less<>>& keywords_read() {
  static const std::set<std::string, std::less<>> names{"HEADING",
                                                        "PART",
                                                        "END PART",
                                                        "INSTANCE",
                                                        "END INSTANCE",
                                                        "ASSEMBLY",
                                                        "END ASSEMBLY",
                                                        "NODE",
                                                        "NODAL THICKNESS",
                                                        "ELEMENT",
                                                        "NGEN",
                                                        "NFILL",
                                                        "NCOPY",
                                                        "ELGEN",
                                                        "ELCOPY",
                                                        "CONTACT PAIR",
                                                        "NSET",
                                                        "ELSET",
                                                        "SURFACE",
                                                        "TRANSFORM",
                                                        "ORIENTATION",
                                                        "MATERIAL",
                                                        "ELASTIC",
                                                        "DENSITY",
                                                        "PLASTIC",
                                                        "EXPANSION",
                                                        "INITIAL CONDITIONS",
                                                        "TEMPERATURE",
                                                        "CONDUCTIVITY",
                                                        "SPECIFIC HEAT",
                                                        "DAMPING",
                                                        "DEPVAR",
                                                        "CREEP",
                                                        "RATE DEPENDENT",
                                                        "SHELL SECTION",
                                                        "SHELL GENERAL SECTION",
                                                        "BEAM SECTION",
                                                        "BEAM GENERAL SECTION",
                                                        "CENTROID",
                                                        "SHEAR CENTER",
                                                        "SECTION POINTS",
                                                        "TRANSVERSE SHEAR STIFFNESS",
                                                        "BEAM SECTION OFFSET",
                                                        "SOLID SECTION",
                                                        "NORMAL",
                                                        "MASS",
                                                        "ROTARY INERTIA",
                                                        "NONSTRUCTURAL MASS",
                                                        "RELEASE",
                                                        "SPRING",
                                                        "COUPLING",
                                                        "KINEMATIC COUPLING",
                                                        "TIE",
                                                        "SHELL TO SOLID COUPLING",
                                                        "DISTRIBUTING COUPLING",
                                                        "KINEMATIC",
                                                        "DISTRIBUTING",
                                                        "RIGID BODY",
                                                        "MPC",
                                                        "EQUATION",
                                                        "BOUNDARY",
                                                        "STEP",
                                                        "END STEP",
                                                        "CLOAD",
                                                        "DLOAD",
                                                        "DSLOAD"};
  return names;
}

/// Keywords that ask for output, or tell a solver how to go about.
const std::set<std::string, std::less<>>& wishes() {
  static const std::set<std::string, std::less<>> names{"PREPRINT",
                                                        "OUTPUT",
                                                        "NODE OUTPUT",
                                                        "ELEMENT OUTPUT",
                                                        "CONTACT OUTPUT",
                                                        "ENERGY OUTPUT",
                                                        "INTEGRATED OUTPUT",
                                                        "NODE PRINT",
                                                        "EL PRINT",
                                                        "NODE FILE",
                                                        "EL FILE",
                                                        "CONTACT FILE",
                                                        "SECTION PRINT",
                                                        "SECTION FILE",
                                                        "FILE FORMAT",
                                                        "FILE OUTPUT",
                                                        "RESTART",
                                                        "MONITOR",
                                                        "STATIC",
                                                        "CONTROLS",
                                                        "SOLVER CONTROLS",
                                                        "SECTION CONTROLS",
                                                        "HOURGLASS STIFFNESS",
                                                        "PHYSICAL CONSTANTS",
                                                        "TIME POINTS",
                                                        "DIAGNOSTICS",
                                                        "INTEGRATED OUTPUT SECTION",
                                                        "WAVEFRONT MINIMIZATION"};
  return names;
}

/// Keywords that change nothing in what a block weighs or how it bears a load given otherwise.
const std::set<std::string, std::less<>>& keywords_left_out() {
  static const std::set<std::string, std::less<>> names{"FREQUENCY",
                                                        "DYNAMIC",
                                                        "BUCKLE",
                                                        "MODAL DYNAMIC",
                                                        "STEADY STATE DYNAMICS",
                                                        "AMPLITUDE",
                                                        "DASHPOT",
                                                        "SURFACE INTERACTION",
                                                        "FRICTION",
                                                        "SURFACE BEHAVIOR",
                                                        "BASE STATE",
                                                        "MODAL DAMPING",
                                                        "CONTACT",
                                                        "CONTACT INCLUSIONS",
                                                        "CONTACT EXCLUSIONS",
                                                        "CONTACT PROPERTY ASSIGNMENT",
                                                        "CONTACT INITIALIZATION DATA",
                                                        "CONTACT INITIALIZATION ASSIGNMENT",
                                                        "CONTACT CONTROLS",
                                                        "CONTACT CONTROLS ASSIGNMENT",
                                                        "CONTACT FORMULATION",
                                                        "CONTACT DAMPING",
                                                        "CONTACT STABILIZATION",
                                                        "SURFACE PROPERTY ASSIGNMENT",
                                                        "CLEARANCE",
                                                        "GAP CONDUCTANCE"};
  return names;
}

/// Keywords of Abaqus' and CalculiX' steps beyond those: other ways of solving, other loads, and
/// what is printed.
const std::set<std::string, std::less<>>& keywords_of_steps() {
  static const std::set<std::string, std::less<>> names{"ADAPTIVE MESH",
                                                        "ADAPTIVE MESH CONSTRAINT",
                                                        "ADAPTIVE MESH CONTROLS",
                                                        "ANNEAL",
                                                        "BASE MOTION",
                                                        "BUCKLING ENVELOPE",
                                                        "BULK VISCOSITY",
                                                        "C ADDED MASS",
                                                        "CFILM",
                                                        "CFLOW",
                                                        "CFLUX",
                                                        "CHANGE FRICTION",
                                                        "COMPLEX FREQUENCY",
                                                        "CONNECTOR LOAD",
                                                        "CONNECTOR MOTION",
                                                        "CONTACT CLEARANCE ASSIGNMENT",
                                                        "CONTACT INTERFERENCE",
                                                        "CONTACT PRINT",
                                                        "CONTOUR INTEGRAL",
                                                        "CORRELATION",
                                                        "COUPLED TEMPERATURE-DISPLACEMENT",
                                                        "COUPLED THERMAL-ELECTRICAL",
                                                        "CRADIATE",
                                                        "D ADDED MASS",
                                                        "DECHARGE",
                                                        "DFLOW",
                                                        "DFLUX",
                                                        "DIRECT CYCLIC",
                                                        "DSFLOW",
                                                        "DSFLUX",
                                                        "DYNAMIC TEMPERATURE-DISPLACEMENT",
                                                        "ELECTROMAGNETIC",
                                                        "ENERGY FILE",
                                                        "ENERGY PRINT",
                                                        "FIELD",
                                                        "FILM",
                                                        "FIXED MASS SCALING",
                                                        "FLOW",
                                                        "GEOSTATIC",
                                                        "GLOBAL DAMPING",
                                                        "GREEN",
                                                        "HEAT TRANSFER",
                                                        "IMPEDANCE",
                                                        "INCIDENT WAVE",
                                                        "INCIDENT WAVE INTERACTION",
                                                        "INCREMENTATION OUTPUT",
                                                        "MASS DIFFUSION",
                                                        "MASS FLOW RATE",
                                                        "MATRIX GENERATE",
                                                        "MATRIX OUTPUT",
                                                        "MODAL FILE",
                                                        "MODAL OUTPUT",
                                                        "MODAL PRINT",
                                                        "MOTION",
                                                        "NODE RESPONSE",
                                                        "PRINT",
                                                        "RADIATE",
                                                        "RADIATION FILE",
                                                        "RADIATION OUTPUT",
                                                        "RADIATION PRINT",
                                                        "RANDOM RESPONSE",
                                                        "RESPONSE SPECTRUM",
                                                        "RETAINED NODAL DOFS",
                                                        "SELECT CYCLIC SYMMETRY MODES",
                                                        "SELECT EIGENMODES",
                                                        "SENSITIVITY",
                                                        "SFILM",
                                                        "SFLOW",
                                                        "SIMPEDANCE",
                                                        "SOILS",
                                                        "SOLUTION TECHNIQUE",
                                                        "SRADIATE",
                                                        "STEADY STATE TRANSPORT",
                                                        "SUBSTRUCTURE GENERATE",
                                                        "SUBSTRUCTURE LOAD CASE",
                                                        "SUBSTRUCTURE MATRIX OUTPUT",
                                                        "SUBSTRUCTURE OUTPUT",
                                                        "SURFACE OUTPUT",
                                                        "TRANSPORT VELOCITY",
                                                        "UNCOUPLED TEMPERATURE-DISPLACEMENT",
                                                        "VARIABLE MASS SCALING",
                                                        "VIEWFACTOR",
                                                        "VISCO",
                                                        "FEASIBLE DIRECTION",
                                                        "OBJECTIVE",
                                                        "CONSTRAINT",
                                                        "DESIGN RESPONSE",
                                                        "CRACK PROPAGATION",
                                                        "ROBUST DESIGN",
                                                        "ELEMENT RESPONSE",
                                                        "CHANGE CONTACT TYPE",
                                                        "CHANGE SURFACE BEHAVIOR",
                                                        "CECHARGE",
                                                        "CECURRENT",
                                                        "DECURRENT",
                                                        "DSECHARGE",
                                                        "DSECURRENT",
                                                        "CREEP STRAIN RATE CONTROL"};
  return names;
}

/// Keywords that there are, that are not known here, and what to give in their place.
std::string_view instead_of_keyword(const std::string& keyword) {
  static const std::map<std::string, const char*, std::less<>> all{
      {"CONNECTOR SECTION", "say by *COUPLING, *MPC, *EQUATION or *SPRING what connectors join"},
      {"CONNECTOR BEHAVIOR", "say by *SPRING what connectors resist"},
      {"CONNECTOR ELASTICITY", "say by *SPRING what connectors resist"},
      {"FASTENER", "join the plates by *COUPLING or *MPC at each fastener"},
      {"FASTENER PROPERTY", "join the plates by *COUPLING or *MPC at each fastener"},
      {"MEMBRANE SECTION", "membranes do not bend; S3, S4R, S6 and S8R with *SHELL SECTION do"},
      {"SURFACE SECTION", "surface elements bear nothing; take them out of the deck"},
      {"COHESIVE SECTION", "layers of glue are not known; *TIE joins what they join"},
      {"GASKET SECTION", "gaskets are not known; *TIE joins what they join"},
      {"GAP", "what gapes is not known, for a lift is linear"},
      {"USER ELEMENT", "elements of the user's own are not known"},
      {"PRE-TENSION SECTION", "a bolt's preload is not known; its solids or bars alone can stand"},
      {"EMBEDDED ELEMENT", "give embedded bars nodes of their host"},
      {"LOAD CASE", "give each load case of a step a step of its own"},
      {"END LOAD CASE", "give each load case of a step a step of its own"},
      {"MODEL CHANGE",
       "elements that go and come again are not known; give a deck of its own for each state"},
      {"INERTIA RELIEF",
       "hold the model by supports in place of its inertia; a lift hangs on ropes"},
      {"MASS ADJUST", "give the masses as they are to be"},
      {"PRESSURE PENETRATION",
       "give the pressure by *DLOAD or *DSLOAD on the faces that it reaches"},
      {"PRESSURE STRESS", "stress that is given beforehand is not known"},
      {"SUBSTRUCTURE GENERATE", "give the parts themselves in place of a substructure"},
      {"MATRIX INPUT", "give the parts themselves in place of a matrix"}};
  const auto found = all.find(keyword);
  return found == all.end() ? std::string_view() : found->second;
}

/// All of them, with their asterisk.
const std::vector<std::string>& all_names() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> names;
    for (const auto* some :
         {&keywords_read(), &wishes(), &keywords_left_out(), &keywords_of_steps()})
      for (const std::string& name : *some) names.push_back("*" + name);
    return names;
  }();
  return all;
}

/// Blanks within its name do not count.
bool is_keyword_read(const std::string& name) {
  static const std::set<std::string, std::less<>> names = [] {
    std::set<std::string, std::less<>> all;
    for (const std::string& known : keywords_read()) all.insert(without_blanks(known));
    return all;
  }();
  return names.contains(without_blanks(name));
}

/// Gives names that are written without the blanks within them, such as ENDSTEP, their own.
void restore_blanks(std::vector<AbaqusBlock>& blocks) {
  std::map<std::string, std::string> name_of;
  for (const auto* names :
       {&keywords_read(), &wishes(), &keywords_left_out(), &keywords_of_steps()})
    for (const std::string& name : *names) name_of.emplace(without_blanks(name), name);
  for (AbaqusBlock& block : blocks)
    if (const auto name = name_of.find(without_blanks(block.name)); name != name_of.end())
      block.name = name->second;
}

void take_stock_of_keywords(AbaqusModel& model, const std::vector<AbaqusBlock>& blocks) {
  bool in_step = false;
  for (const AbaqusBlock& block : blocks) {
    if (block.name == "STEP" || block.name == "END STEP") in_step = block.name == "STEP";
    if (block.name == "HEADING") {
      if (!block.data.empty()) model.deck.title = std::string(block.data.front().text);
      model.log.use("*HEADING");
    }
    if (keywords_read().count(block.name) > 0) continue;
    // Elements may go at a restart, which changes nothing yet; contact is left out as it is.
    const bool changes_no_element =
        block.name == "MODEL CHANGE" &&
        (block.has("ACTIVATE") || without_blanks(block.value("TYPE")) == "CONTACTPAIR");
    if (changes_no_element)
      model.log.leave_out("*MODEL CHANGE", "of contact, or for restarts alone");
    else if (wishes().count(block.name) > 0)
      model.log.leave_out_wish("*" + block.name, "what is printed, or how it is solved");
    else if (keywords_left_out().count(block.name) > 0)
      model.log.leave_out("*" + block.name, "what no plate or beam meets in a static load case");
    else if (in_step && keywords_of_steps().count(block.name) > 0)
      model.log.leave_out("*" + block.name, "what a step does beyond its supports and forces");
    else
      model.log.miss(block.line, "*" + block.name, model.options, all_names(),
                     keywords_of_steps().count(block.name) > 0
                         ? "it is known in steps alone, and stands in none"
                         : instead_of_keyword(block.name));
  }
}

}  // namespace

Deck read_abaqus(const std::filesystem::path& path, const UnitSystem& units,
                 const DeckOptions& options) {
  DeckLog log;
  DeckFiles files(log);
  std::vector<AbaqusBlock> blocks = read_abaqus_keywords(files, path, log, is_keyword_read);
  restore_blanks(blocks);
  Deck deck;
  deck.path = path;
  deck.files = files.paths();
  deck.units = units;
  AbaqusModel model(log, deck, options);
  take_stock_of_keywords(model, blocks);
  remark_on_unread_parameters(blocks, log);
  read_abaqus_cells(model, blocks);
  if (deck.mesh.vertices.empty()) log.complain({}, "the deck has no nodes");
  read_abaqus_sections(model);
  read_abaqus_transforms(model);
  read_abaqus_links(model);
  read_abaqus_ties(model);
  read_abaqus_steps(model);
  log.check_left_out(options);
  log.check();
  fasten_used_middles(deck, model.middles);
  deck.expansions.of_materials.resize(deck.mesh.materials.size());
  log.hand_over(deck);
  return deck;
}

}  // namespace blocklift::structure
