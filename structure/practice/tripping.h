#pragma once

#include "structure/material.h"

namespace blocklift::structure {

/// Section of a stiffener that turns about its toe, where it stands on its plate: the plate holds
/// the toe sideways.
struct TrippingSection {
  double torsion = 0;        ///< I_t of Saint-Venant, m^4
  double polar_moment = 0;   ///< I_po = int r^2 dA, r from the toe, m^4
  double shear_height = 0;   ///< h_s of the shear centre above the toe, m
  double second_moment = 0;  ///< I_z of bending along the plate, about the own centroid, m^4
};

/// Elastic stress at which an evenly pressed stiffener turns about its toe, Pa:
///   f_ET = beta G I_t / I_po + pi^2 E h_s^2 I_z / (I_po l_T^2),  beta = 1.
/// The plate's own resistance to turning, a beta above 1, is left out. DNV-RP-C201 (October 2010),
/// 7.5.2, equation 7.31.
/// @param length l_T between what holds the stiffener sideways, m.
double tripping_stress(const Material& material, const TrippingSection& section, double length);

/// Stress at which it trips, Pa: yield up to a slenderness lambda = sqrt(f_y / f_ET) of 0.6, beyond
///   f_T = f_y (1 + mu + lambda^2 - sqrt((1 + mu + lambda^2)^2 - 4 lambda^2)) / (2 lambda^2),
///   mu = 0.35 (lambda - 0.6).
/// DNV-RP-C201 (October 2010), 7.5.2, equations 7.27 to 7.30.
double tripping_strength(double elastic, double yield);

}  // namespace blocklift::structure
