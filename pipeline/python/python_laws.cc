#include "pipeline/python/python_laws.h"

#include <chrono>
#include <memory>
#include <mutex>
#include <span>
#include <stdexcept>
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

/// How deep this thread is in calls into Python, on the way of a lift.
thread_local int calls_on_the_way = 0;

/// Calls into Python, with its lock.
template <class Call>
auto call(const Call& what) {
  const py::gil_scoped_acquire lock;
  struct OnTheWay {
    OnTheWay() { ++calls_on_the_way; }
    ~OnTheWay() { --calls_on_the_way; }
    OnTheWay(const OnTheWay&) = delete;
    OnTheWay& operator=(const OnTheWay&) = delete;
  };
  const OnTheWay until_it_returns;
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
  if (calls_on_the_way > 0)
    throw std::runtime_error("a law cannot begin a lift: one lift runs in a process at a time");
  static std::timed_mutex one_at_a_time;
  constexpr std::chrono::milliseconds between_looks(100);
  try {
    const py::gil_scoped_release without_lock;
    std::unique_lock turn(one_at_a_time, std::defer_lock);
    while (!turn.try_lock_for(between_looks)) see_to_signals("", 0, "");
    compute();
  } catch (const RaisedInPython& raised) {
    std::rethrow_exception(raised.what);
  }
}

void see_to_signals(const std::string&, double, const std::string&) {
  // Another thread of Python's may hold its lock for 5 ms, and steps are many.
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds between_looks(50);
  thread_local Clock::time_point last;
  const Clock::time_point now = Clock::now();
  if (now - last < between_looks) return;
  last = now;
  call([] {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  });
}

}  // namespace blocklift::pipeline
