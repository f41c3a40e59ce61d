#pragma once

#include <gtest/gtest.h>

#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::pipeline::test {

/// Expects all of one database in the other, to the last bit.
inline void expect_same(const dynamics::HydrodynamicDatabase& a,
                        const dynamics::HydrodynamicDatabase& b) {
  EXPECT_EQ(a.water.density, b.water.density);
  EXPECT_EQ(a.water.gravity, b.water.gravity);
  EXPECT_EQ(a.water.depth, b.water.depth);
  EXPECT_EQ(a.body_names, b.body_names);
  EXPECT_EQ(a.reference_points, b.reference_points);
  EXPECT_EQ(a.displaced_volumes, b.displaced_volumes);
  EXPECT_EQ(a.centres_of_buoyancy, b.centres_of_buoyancy);
  EXPECT_EQ(a.centres_of_mass, b.centres_of_mass);
  EXPECT_EQ(a.hydrostatic_stiffness, b.hydrostatic_stiffness);
  EXPECT_EQ(a.infinite_added_mass, b.infinite_added_mass);
  EXPECT_EQ(a.change_from_coarser, b.change_from_coarser);
  EXPECT_EQ(a.excitation_change_from_coarser, b.excitation_change_from_coarser);
  EXPECT_EQ(a.cut_off_by_end, b.cut_off_by_end);
  EXPECT_EQ(a.time_step, b.time_step);
  EXPECT_EQ(a.retardation, b.retardation);
  EXPECT_EQ(a.frequencies, b.frequencies);
  EXPECT_EQ(a.added_mass, b.added_mass);
  EXPECT_EQ(a.damping, b.damping);
  EXPECT_EQ(a.headings, b.headings);
  EXPECT_EQ(a.froude_krylov, b.froude_krylov);
  EXPECT_EQ(a.diffraction, b.diffraction);
  EXPECT_EQ(a.mean_drift, b.mean_drift);
}

}  // namespace blocklift::pipeline::test
