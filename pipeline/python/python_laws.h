#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <functional>

#include "pipeline/files/lift_case/own_laws.h"
#include "pipeline/lift/lift_run.h"

namespace blocklift::pipeline {

/// What Python has raised, on its way through the rooms: no exception of theirs, so that none of
/// those that go on after a failure (a member of a study, what errors in lengths do) takes it for
/// one.
struct RaisedInPython {
  std::exception_ptr what;
};

/// Functions and classes of Python as laws. A class is called at the beginning of each run, once a
/// drive.
OwnLaws laws_of(const pybind11::dict& functions);

/// Calls what computes lifts, without Python's lock. The rooms and their libraries (HDF5, Gmsh,
/// OpenTURNS' random numbers) take one lift at a time: other threads wait for their turn.
/// @throws pybind11::error_already_set, pybind11::type_error what Python raised on the way;
///   std::runtime_error if a law, or what sees to a signal, begins another lift.
void run_beside_python(const std::function<void()>& compute);

/// Lets Python see to signals, of which Ctrl-C raises KeyboardInterrupt. For a run's progress.
void see_to_signals(const std::string& stage, double fraction, const std::string& detail);

}  // namespace blocklift::pipeline
