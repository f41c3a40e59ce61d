// The module blocklift._kernel: lifts that run in Python's own process, so that functions of Python
// can steer their drives. The package calls it (blocklift/kernel.py); nobody else does.
#include <pybind11/pybind11.h>

#include <algorithm>
#include <exception>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pipeline/assessment/assess.h"
#include "pipeline/declaration/diagnostics.h"
#include "pipeline/files/named_file.h"
#include "pipeline/simulation/lift_simulation.h"
#include "pipeline/version.h"

namespace blocklift::pipeline {
namespace {

namespace py = pybind11;

/// An object of Python's that may be let go by a thread that does not hold Python's lock.
using Kept = std::shared_ptr<py::object>;

Kept keep(py::object object) {
  return {new py::object(std::move(object)), [](py::object* kept) {
            const py::gil_scoped_acquire lock;
            delete kept;
          }};
}

/// Asks a law for the speed of its drive.
/// @throws pybind11::error_already_set what the law raises; pybind11::type_error if it gives no
///   number.
double ask(const py::object& law, const std::string& name, const std::vector<std::string>& figures,
           double time, std::span<const double> seen) {
  const py::gil_scoped_acquire lock;
  py::dict by_name;
  for (std::size_t i = 0; i < seen.size(); ++i) by_name[figures[i].c_str()] = seen[i];
  const py::object speed = law(time, by_name);
  const double value = PyFloat_AsDouble(speed.ptr());
  if (PyErr_Occurred() == nullptr) return value;
  if (PyErr_ExceptionMatches(PyExc_TypeError) == 0) throw py::error_already_set();
  PyErr_Clear();
  throw py::type_error(fmt::format("law \"{}\" gave {} at {:.6g} s; it must give a speed, a number",
                                   name, std::string(py::repr(speed)), time));
}

/// @param law a function, or a class whose objects are called: each run and each drive has its own.
LawMaker maker_of(const std::string& name, const Kept& law) {
  return [name, law](const std::vector<std::string>& figures) -> dynamics::SpeedLaw {
    const py::gil_scoped_acquire lock;
    const Kept own = PyType_Check(law->ptr()) != 0 ? keep((*law)()) : law;
    return [name, figures, own](double time, std::span<const double> seen) {
      return ask(*own, name, figures, time, seen);
    };
  };
}

/// Laws that are given are laws that the case names.
void check_laws(const LiftCase& lift_case) {
  std::vector<std::string> known;
  for (const StageInCase& stage : lift_case.operation)
    for (const MoveInCase& move : stage.moves)
      if (move.keeps && move.keeps->law) known.push_back(move.keeps->law->value);
  Diagnostics diagnostics;
  for (const auto& [name, law] : lift_case.laws) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string hint =
        known.empty() ? fmt::format("a move has it by {{drives: [...], keeps: {{law: {}}}}}", name)
                      : names_hint("its laws are", known, name);
    diagnostics.error({std::make_shared<const std::string>(lift_case.file.string()), 0, 0},
                      fmt::format("no drive of the case is steered by a law \"{}\"", name), {hint});
  }
  if (diagnostics.has_errors()) throw InputError(diagnostics);
}

/// Lets Python see to signals, of which Ctrl-C raises KeyboardInterrupt.
void see_to_signals() {
  const py::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// @param program beside which models are sought.
void simulate(const std::string& path, const std::string& folder, const std::string& program,
              const py::dict& laws) {
  take_models_of(program);
  std::map<std::string, LawMaker> makers;
  for (const auto& [name, law] : laws) {
    const auto text = name.cast<std::string>();
    makers.emplace(text, maker_of(text, keep(py::reinterpret_borrow<py::object>(law))));
  }
  const py::gil_scoped_release without_lock;
  LiftCase lift_case = read_lift_case(path);
  require_motion(lift_case);
  lift_case.laws = std::move(makers);
  check_laws(lift_case);
  require_writable(folder);
  require_no_verdict(folder);
  const LiftSimulation simulation =
      simulate_lift(std::move(lift_case),
                    [](const std::string&, double, const std::string&) { see_to_signals(); });
  write_lift_simulation(simulation, folder, false);
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
  module.doc() = "Lifts that run in Python's own process; called by blocklift.Case.";
  pybind11::register_local_exception_translator(translate);
  module.attr("version") = std::string(program_version);
  module.def("simulate", &simulate, pybind11::arg("case"), pybind11::arg("folder"),
             pybind11::arg("program"), pybind11::arg("laws"),
             "Simulates a case and writes its results into a folder.");
}
