#include "pipeline/python/python_laws.h"

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

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

/// Calls into Python, with its lock.
template <class Call>
auto call(const Call& what) {
  const py::gil_scoped_acquire lock;
  try {
    return what();
  } catch (...) {
    throw RaisedInPython{std::current_exception()};
  }
}

/// Asks a law for the speed of its drive.
/// @throws pybind11::error_already_set what the law raises; pybind11::type_error if it gives no
///   number.
double ask(const py::object& law, const std::string& name, const std::vector<std::string>& figures,
           double time, std::span<const double> seen) {
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
    const Kept own = call([&] { return PyType_Check(law->ptr()) != 0 ? keep((*law)()) : law; });
    return [name, figures, own](double time, std::span<const double> seen) {
      return call([&] { return ask(*own, name, figures, time, seen); });
    };
  };
}

}  // namespace

OwnLaws laws_of(const py::dict& functions) {
  OwnLaws laws;
  for (const auto& [name, law] : functions) {
    const auto text = name.cast<std::string>();
    laws.emplace(text, maker_of(text, keep(py::reinterpret_borrow<py::object>(law))));
  }
  return laws;
}

void run_beside_python(const std::function<void()>& compute) {
  try {
    const py::gil_scoped_release without_lock;
    compute();
  } catch (const RaisedInPython& raised) {
    std::rethrow_exception(raised.what);
  }
}

void see_to_signals(const std::string&, double, const std::string&) {
  call([] {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  });
}

}  // namespace blocklift::pipeline
