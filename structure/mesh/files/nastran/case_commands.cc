#include "structure/mesh/files/nastran/case_commands.h"

#include <algorithm>
#include <array>
#include <vector>

#include "structure/letter_case.h"
#include "structure/nearest_name.h"

namespace blocklift::structure {

namespace {

constexpr std::size_t least_letters = 4;  // by which Nastran tells commands apart

constexpr std::array<std::string_view, 278> commands{"A2GG",          "ACCELERATION",
                                                     "ACFPMRESULT",   "ACPOWER",
                                                     "ADACT",         "ADAMSMNF",
                                                     "ADAPT",         "AECONFIG",
                                                     "AERCONFIG",     "AESYMXY",
                                                     "AESYMXZ",       "AEUXREF",
                                                     "ALOAD",         "ANALYSIS",
                                                     "APRESSURE",     "ASCALE",
                                                     "ASSIGN",        "AUTOSPC",
                                                     "AUXCASE",       "AUXMODEL",
                                                     "AXISYMMETRIC",  "B2GG",
                                                     "B2PP",          "BC",
                                                     "BCHANGE",       "BCMOVE",
                                                     "BCONTACT",      "BCRESULTS",
                                                     "BCSET",         "BGRESULTS",
                                                     "BGSET",         "BOLTLD",
                                                     "BOLTRESULTS",   "BOUTPUT",
                                                     "BSQUEAL",       "CAMPBELL",
                                                     "CKGAP",         "CLOAD",
                                                     "CMETHOD",       "CMSENERGY",
                                                     "CMSMETH",       "CNTNLSUB",
                                                     "CONTF",         "CRSTRN",
                                                     "CSSCHD",        "CSTRAIN",
                                                     "CSTRESS",       "CZRESULTS",
                                                     "DATAREC",       "DEACTEL",
                                                     "DEFORM",        "DENSITY",
                                                     "DESGLB",        "DESMOD",
                                                     "DESOBJ",        "DESSUB",
                                                     "DESVAR",        "DIAG",
                                                     "DISPLACEMENT",  "DIVERG",
                                                     "DLOAD",         "DMIGMOD",
                                                     "DMTRCOEF",      "DRSPAN",
                                                     "DSAPRT",        "DSYM",
                                                     "DTEMP",         "DYNRED",
                                                     "ECHO",          "ECHOOFF",
                                                     "ECHOON",        "EDE",
                                                     "EFLOAD",        "EIGVRETRIEVE",
                                                     "EIGVSAVE",      "EKE",
                                                     "ELAR",          "ELFORCE",
                                                     "ELSDCON",       "ELSTRAIN",
                                                     "ELSTRESS",      "ELSTRN",
                                                     "ELSUM",         "ENERGY",
                                                     "ENTHALPY",      "EQUILIBRIUM",
                                                     "ERP",           "ESE",
                                                     "ESLOAD",        "EXTDRIN",
                                                     "EXTDROUT",      "EXTSEOUT",
                                                     "FATIGUE",       "FBODYLD",
                                                     "FLSFSEL",       "FLSPOUT",
                                                     "FLSTCNT",       "FLUX",
                                                     "FMETHOD",       "FORCE",
                                                     "FORMAT",        "FREQUENCY",
                                                     "FRF",           "FTNRESULT",
                                                     "GCRESULTS",     "GKRESULTS",
                                                     "GPFORCE",       "GPKE",
                                                     "GPRSORT",       "GPSDCON",
                                                     "GPSTRAIN",      "GPSTRESS",
                                                     "GRDCON",        "GROUNDCHECK",
                                                     "GUST",          "HADAPT",
                                                     "HARMONICS",     "HDOT",
                                                     "HISOUT",        "HOUTPUT",
                                                     "HTFLOW",        "IC",
                                                     "ICF",           "INCLUDE",
                                                     "INITS",         "INPOWER",
                                                     "INTENSITY",     "INTERFACE",
                                                     "IRLOAD",        "K2GG",
                                                     "K2PP",          "K42GG",
                                                     "LABEL",         "LINE",
                                                     "LOAD",          "LOADNAME",
                                                     "LOADSET",       "M2GG",
                                                     "M2PP",          "MASTER",
                                                     "MAXLINES",      "MAXMIN",
                                                     "MCFRACTION",    "MCHSTAT",
                                                     "MEFFMASS",      "METHOD",
                                                     "MFLUID",        "MODALKE",
                                                     "MODALSE",       "MODEL",
                                                     "MODES",         "MODESELECT",
                                                     "MODTRAK",       "MONITOR",
                                                     "MONVAR",        "MPC",
                                                     "MPCFORCES",     "MPRES",
                                                     "MSGLIMIT",      "NLBUCK",
                                                     "NLCNTL",        "NLHARM",
                                                     "NLIC",          "NLLOAD",
                                                     "NLOPRM",        "NLOUT",
                                                     "NLPARM",        "NLRESTART",
                                                     "NLSTEP",        "NLSTRESS",
                                                     "NONLINEAR",     "NOUTPUT",
                                                     "NSM",           "OFREQUENCY",
                                                     "OLOAD",         "OMODES",
                                                     "OTEMP",         "OTIME",
                                                     "OUTPUT",        "OUTRCV",
                                                     "P2G",           "PACCELERATION",
                                                     "PAGE",          "PARAM",
                                                     "PARTN",         "PEAKOUT",
                                                     "PFGRID",        "PFMODE",
                                                     "PFPANEL",       "PLOTID",
                                                     "PLSTRN",        "POST",
                                                     "PRESSURE",      "PRETENSION",
                                                     "PROGOUT",       "PROPERTY",
                                                     "RANDOM",        "RCROSS",
                                                     "REPCASE",       "REPGLB",
                                                     "REPSUB",        "RESPRINT",
                                                     "RESULTS",       "RESVEC",
                                                     "RGYRO",         "RIGID",
                                                     "RSDAMP",        "SACCELERATION",
                                                     "SCREEN",        "SDAMPING",
                                                     "SDISPLACEMENT", "SEALL",
                                                     "SEDR",          "SEDV",
                                                     "SEEXCLUDE",     "SEFINAL",
                                                     "SEKREDUCE",     "SELGENERATE",
                                                     "SELREDUCE",     "SEMGENERATE",
                                                     "SEMREDUCE",     "SERESP",
                                                     "SET",           "SETMC",
                                                     "SETP",          "SETS",
                                                     "SHAPE",         "SHELLTHK",
                                                     "SKIP",          "SKIPOFF",
                                                     "SKIPON",        "SMETHOD",
                                                     "SPC",           "SPCFORCES",
                                                     "STATSUB",       "STATVAR",
                                                     "STEP",          "STOCHASTICS",
                                                     "STRAIN",        "STRESS",
                                                     "STRFIELD",      "SUBCASE",
                                                     "SUBCOM",        "SUBSEQ",
                                                     "SUBSEQ1",       "SUBSTEP",
                                                     "SUBTITLE",      "SUPER",
                                                     "SUPORT1",       "SURFACE",
                                                     "SVECTOR",       "SVELOCITY",
                                                     "SYM",           "SYMCOM",
                                                     "SYMSEQ",        "SYSSETTING",
                                                     "TEMPERATURE",   "TFL",
                                                     "THERMAL",       "THICKNESS",
                                                     "THIN",          "THSTRN",
                                                     "TITLE",         "TRIM",
                                                     "TRIMGRP",       "TSTEP",
                                                     "TSTEPNL",       "TSTRU",
                                                     "UNGLUE",        "VCCT",
                                                     "VECTOR",        "VELOCITY",
                                                     "VOLUME",        "WEIGHTCHECK",
                                                     "XTITLE",        "XYPLOT",
                                                     "XYPRINT",       "XYPUNCH"};

}  // namespace

bool is_case_command(std::string_view name) {
  const std::string asked = upper(std::string(name));
  const auto may_be_cut = [](std::string_view command) {
    return !command.starts_with("SUBC");  // SUBCASE or SUBCOM
  };
  return std::any_of(commands.begin(), commands.end(), [&](std::string_view command) {
    return command == asked ||
           (asked.size() >= least_letters && command.starts_with(asked) && may_be_cut(command));
  });
}

std::string meant_case_command(std::string_view name) {
  static const std::vector<std::string> of_cases{"SUBCASE", "LOAD", "SPC",        "MPC",
                                                 "NSM",     "TEMP", "TEMPERATURE"};
  const std::string asked = upper(std::string(name));
  constexpr std::size_t least_beginning = 3;
  if (asked.size() >= least_beginning)
    for (const std::string& command : of_cases)
      if (command.starts_with(asked)) return command;
  return nearest_name(asked, of_cases);
}

}  // namespace blocklift::structure
