#pragma once

#include <array>
#include <string>
#include <vector>

#include "pipeline/files/vessel/hydrodynamic_settings.h"

namespace blocklift::pipeline {

/// A vessel with its place in the world.
struct PlacedVessel {
  Located<std::string> vessel;       ///< model, or its file
  std::array<double, 2> position{};  ///< of its origin, m
  double heading = 0.0;              ///< of its x axis, from the world's x towards y, rad
  std::vector<double> draughts;      ///< upright, m; empty: afloat by its weight
};

/// Several vessels whose flows act on each other.
struct VesselGroup {
  std::string kind;
  std::string title;
  std::vector<Named<PlacedVessel>> vessels;
  HydrodynamicSettings hydrodynamics;
  Mark place;
};

/// The format of a file of several vessels.
Format<VesselGroup> vessel_group_format();

}  // namespace blocklift::pipeline
