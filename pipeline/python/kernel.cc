// The module blocklift._kernel: lifts that run in Python's own process, so that functions of Python
// can steer their drives. The package calls it (blocklift/kernel.py); nobody else does.
#include <pybind11/pybind11.h>

#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "pipeline/assessment/assess.h"
#include "pipeline/build/build_mechanism.h"
#include "pipeline/declaration/asked_changes.h"
#include "pipeline/declaration/diagnostics.h"
#include "pipeline/files/file_kind.h"
#include "pipeline/files/library/model_library.h"
#include "pipeline/files/lift_case/own_laws.h"
#include "pipeline/files/named_file.h"
#include "pipeline/formats/hdf5_exit.h"
#include "pipeline/python/python_laws.h"
#include "pipeline/simulation/lift_simulation.h"
#include "pipeline/simulation/mechanism_results.h"
#include "pipeline/simulation/mechanism_run.h"
#include "pipeline/study/members/study_blocks.h"
#include "pipeline/study/pages/study_files.h"
#include "pipeline/study/results/study_results.h"
#include "pipeline/study/run/study_lock.h"
#include "pipeline/study/run/study_run.h"
#include "pipeline/version.h"

namespace blocklift::pipeline {
namespace {

namespace py = pybind11;

std::vector<std::string> texts_of(const py::list& list) {
  std::vector<std::string> texts;
  for (const py::handle& text : list) texts.push_back(text.cast<std::string>());
  return texts;
}

/// Reads a case whose drives the laws steer.
LiftCase read_steered_case(const std::string& path, const std::vector<std::string>& set,
                           const OwnLaws& laws) {
  LiftCase lift_case = read_lift_case(path, read_asked_changes(set));
  lift_case.laws = laws;
  Diagnostics diagnostics;
  check_laws(lift_case.laws, lift_case.operation, lift_case.file, diagnostics);
  if (diagnostics.has_errors()) throw InputError(diagnostics);
  return lift_case;
}

void simulate_mechanism(const std::string& path, const std::string& folder,
                        const std::vector<std::string>& set, const OwnLaws& laws) {
  ModelLibrary library = ModelLibrary::of_installation();
  library.set_changes(read_asked_changes(set));
  Diagnostics diagnostics;
  std::optional<MechanismFile> file = read_mechanism(path, library, diagnostics);
  if (file) check_laws(laws, file->operation, file->file, diagnostics);
  if (diagnostics.has_errors()) throw InputError(diagnostics);
  file->laws = laws;
  require_writable(folder);
  require_no_verdict(folder);
  const MechanismRun run = run_mechanism(
      *file, [](double fraction, double) { see_to_signals("time integration", fraction, ""); });
  write_mechanism_results(*file, run, folder, false);
}

/// @param program beside which models are sought. @param set keys with other values.
void simulate(const std::string& path, const std::string& folder, const std::string& program,
              const py::dict& laws, const py::list& set) {
  run_beside_python([&, laws = laws_of(laws), set = texts_of(set)] {
    take_models_of(program);
    if (kind_of_file(path) == FileKind::mechanism) {
      simulate_mechanism(path, folder, set, laws);
      return;
    }
    LiftCase lift_case = read_steered_case(path, set, laws);
    require_motion(lift_case);
    require_writable(folder);
    require_no_verdict(folder);
    write_lift_simulation(simulate_lift(std::move(lift_case), see_to_signals), folder, false);
  });
}

// What the laws do is not known: nothing is kept of a run that was stopped.
void assess_case(const std::string& path, const std::string& folder, const std::string& program,
                 const py::dict& laws, bool decks, const py::list& set) {
  run_beside_python([&, laws = laws_of(laws), set = texts_of(set)] {
    take_models_of(program);
    LiftCase lift_case = read_steered_case(path, set, laws);
    require_writable(folder);
    const Assessment assessment = assess(std::move(lift_case), see_to_signals);
    write_results(assessment, folder,
                  decks ? load_case_files(assessment) : std::vector<LoadCaseFile>());
  });
}

// Functions cannot be handed to other processes: members run here, one after another.
py::list sweep(const std::string& path, const std::string& folder, const std::string& program,
               const py::dict& laws) {
  std::vector<std::string> doubts;
  run_beside_python([&, laws = laws_of(laws)] {
    take_models_of(program);
    StudyFile study = read_study(path);
    study.laws = laws;
    require_writable(folder);
    const auto watch = [](double fraction) { see_to_signals("reading members", fraction, ""); };
    Eigen::MatrixXd design = plan_members(study, watch);
    const StudyLock until_it_ends(folder, StudyLock::Use::whole);
    const MemberStore store(folder, identity_of_study(study));
    const StudyCrew crew = {
        .compute_missing =
            [&](const StudyFile& of, const Eigen::MatrixXd& members, const MemberStore& into) {
              compute_one_by_one(of, members, folder, into, see_to_signals);
            },
        .write = [](const MemberStore& into, const Member& member) { into.write(member); },
        .begin_of_search_member = [](int) { see_to_signals("search", 0, ""); },
        .progress = see_to_signals};
    const StudyResults results =
        run_study(std::move(study), std::move(design), folder, store, crew);
    write_study(results, folder);
    doubts = study_warnings(results);
    const std::optional<ShownMember> shown = shown_member(results, folder);
    if (!shown) return;
    const std::filesystem::path members = std::filesystem::path(folder) / "members";
    StudyBlocks blocks(results.study, members, see_to_signals);
    const Member whole = run_member(results.study, results.design.row(shown->number), shown->number,
                                    blocks, shown->folder);
    if (!whole.failure.empty()) throw std::runtime_error(whole.failure);
    if (const std::string failure = failure_of_run(results); !failure.empty())
      throw std::runtime_error(failure);
  });
  py::list list;
  for (const std::string& doubt : doubts) list.append(doubt);
  return list;
}

/// Exceptions of the rooms as those of the package. Python's own pass unchanged.
void translate(std::exception_ptr exception) {  // NOLINT(performance-unnecessary-value-param)
  const py::module_ errors = py::module_::import("blocklift.errors");
  const auto raise = [&](const char* name, const py::object& argument) {
    const py::object type = errors.attr(name);
    PyErr_SetObject(type.ptr(), type(argument).ptr());
  };
  try {
    if (exception) std::rethrow_exception(exception);
  } catch (const py::builtin_exception&) {
    throw;
  } catch (const InputError& error) {
    raise("InputError", errors.attr("complaints_of")(error.what()));
  } catch (const std::runtime_error& error) {
    raise("RunError", py::str(error.what()));
  }
}

}  // namespace
}  // namespace blocklift::pipeline

PYBIND11_MODULE(_kernel, module) {
  using namespace blocklift::pipeline;
  using pybind11::arg;
  leave_no_files_to_hdf5();  // nor Python's end to what a full disk left open
  module.doc() = "Lifts that run in Python's own process; called by blocklift.Case.";
  pybind11::register_local_exception_translator(translate);
  module.attr("version") = std::string(program_version);
  module.def("simulate", &simulate, arg("case"), arg("folder"), arg("program"), arg("laws"),
             arg("set"), "Simulates a case and writes its results into a folder.");
  module.def("assess", &assess_case, arg("case"), arg("folder"), arg("program"), arg("laws"),
             arg("decks"), arg("set"), "Assesses a case and writes its results into a folder.");
  module.def(
      "sweep", &sweep, arg("study"), arg("folder"), arg("program"), arg("laws"),
      "Runs a study, a member after another, and writes its results into a folder; gives what is "
      "doubtful about them.");
}
