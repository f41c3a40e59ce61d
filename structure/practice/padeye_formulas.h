#pragma once

#include <optional>
#include <vector>

#include "structure/material.h"
#include "structure/mesh/padeye/padeye_geometry.h"
#include "structure/rigid_body.h"

namespace blocklift::structure {

/// Doubler plate between a padeye's base and the plating that it stands on, in the middle under the
/// base, welded to the plating all around by a fillet.
struct PadeyeDoubler {
  double length = 0;     ///< along the base, m
  double width = 0;      ///< across it, m
  double thickness = 0;  ///< m
  double weld = 0;       ///< leg of its fillet, m
};

/// What the hand formulae of a padeye take. SI units.
struct PadeyeFormulaInput {
  PadeyeGeometry geometry;
  Material material;
  double cheek_weld = 0;  ///< leg of the fillet around each cheek plate, m
  double base_weld = 0;   ///< leg of the fillets on both sides of the base, m; 0: welded through
  std::optional<PadeyeDoubler> doubler;
  std::optional<double> jaw;               ///< inside width of the shackle, m
  std::optional<double> tensile_strength;  ///< F_u, Pa; ASME BTH-1 is left out without it
  double design_factor = 2;                ///< N_d of ASME BTH-1
  double side_load = 0.05;                 ///< least force along the pin, share of the whole force
};

/// One hand formula: what the lift asks against what may be.
struct PadeyeFormula {
  const char* name = "";
  double demand = 0;
  double limit = 0;
  const char* unit = "Pa";  ///< "Pa", "N", "m" or "1"
  double utilisation = 0;   ///< 1 is the limit
  const char* source = "";
};

/// The hand formulae for a force (N, in the padeye's frame P, all factors in it) at the pin:
///   bearing pressure            F / (D_p T) <= 0.9 F_y
///   tear-out, two shear planes  F / (2 sum t (R - D_H/2)) <= 0.4 F_y
///   net section                 F / sum t (2 R - D_H) <= 0.6 F_y
///   base                        |N|/A / 0.6 F_y + M_in/W_in / 0.66 F_y + M_out/W_out / 0.75 F_y <=
///     1
///   shear in the base           V/A <= 0.4 F_y
///   cheek welds                 F t_c / T on half a circle's throat <= 0.4 F_y
///   base welds, doubler's weld  resultant on the throat a, as an elastic group of lines, <= 0.4
///   F_y:
///     |N|/A + M_in/W_in + M_out/W_out across it, V/A along it; for a rectangle L x B
///     A = 2 a (L + B), W_in = a (L^2/3 + L B), W_out = a (B^2/3 + L B), for the two sides of a
///     base L A = 2 a L, W_in = a L^2 / 3, W_out = a L t
///   doubler's bending           6 m / t_d^2 <= 0.75 F_y, m = (N/L_b + 6 M_in/L_b^2) B/4 + M_out/(2
///     L_b), a strip between the long welds, hinged there, that the base pulls in its middle (N 0
///     where it presses)
///   doubler's bearing           (|N|/A + M_in/W_in) of the base where it presses <= 0.9 F_y
/// (allowables of working-stress design; sums over the plates, T their sum, R their radii), with
/// the part along the pin taken as `side_load` of F at least (API RP 2A);
///   DNV 2.7-3: bearing (Hertz) 0.045 sqrt(F E / (D_H T)), or 0.18 sqrt(F (1/D_p - 1/D_H) E / T)
///     with
///   D_p < 0.94 D_H; tear-out 2 F / sum t (2 R - D_H); both against the yield stress;
///   ASME BTH-1 (3-3.3): see asme_pin_plate.
std::vector<PadeyeFormula> padeye_strength(const PadeyeFormulaInput& input, const Vector3& force_P);

/// The families of padeye_strength by themselves.
std::vector<PadeyeFormula> padeye_working_stress(const PadeyeFormulaInput& input,
                                                 const Vector3& force_P);
std::vector<PadeyeFormula> padeye_dnv_2_7_3(const PadeyeFormulaInput& input,
                                            const Vector3& force_P);
/// Empty without the tensile strength of the plates.
std::vector<PadeyeFormula> padeye_asme_bth_1(const PadeyeFormulaInput& input,
                                             const Vector3& force_P);

/// Plates of a connection made with a pin by EN 1993-1-8 (2005), 3.13, F a design load (all factors
/// in it), the partial factor of resistance 1, plates sharing the load by their thickness:
///   end distance   a = R - D_H/2 >= F / (2 T F_y) + 2/3 D_H   (table 3.9, type A),
///   side distance  c = a         >= F / (2 T F_y) + 1/3 D_H,
///   bearing        F <= 1.5 T D_p F_y                          (table 3.10).
std::vector<PadeyeFormula> padeye_en_1993_1_8(const PadeyeFormulaInput& input,
                                              const Vector3& force_P);

/// What the same rules ask besides of a pin that is replaceable, as that of a shackle is, F without
/// the factors of a design load, the partial factor gamma_M6,ser 1:
///   bearing  F <= 0.6 T D_p F_y                                           (table 3.10),
///   contact  0.591 sqrt(E F (D_H - D_p) / (D_p^2 T)) <= 2.5 F_y           (3.13.2(3)).
std::vector<PadeyeFormula> padeye_en_1993_1_8_replaceable(const PadeyeFormulaInput& input,
                                                          const Vector3& force_P);

/// Rules of practice for a padeye's measures (GL Noble Denton 0027/ND rev. 11.2, section 12): main
/// plate's radius >= D_H; hole larger than the pin by 2 mm or 3 %, at most by 6 mm; cheek plate no
/// thicker than the main plate; plates fill the shackle's jaw to 75 % and enter it.
std::vector<PadeyeFormula> padeye_rules(const PadeyeFormulaInput& input);

/// Allowable loads of a pin-connected plate by ASME BTH-1 (2014), section 3-3.3, N, summed over
/// plates:
///   P_t = C_r F_u / (1.2 N_d) 2 t b_eff,  b_eff = min(b_e, 4 t, 0.6 b_e F_u / F_y sqrt(D_h /
///     b_e)),
///   P_b = C_r F_u / (1.2 N_d) (1.13 (R - D_h/2) + 0.92 b_e / (1 + b_e / D_h)) t,
///   P_v = 0.7 F_u / (1.2 N_d) 2 (a + D_p/2 (1 - cos phi)) t,  phi = 55 D_p / D_h degrees,
///   P_p = 1.25 F_y / N_d D_p t,  C_r = 1 - 0.275 sqrt(1 - D_p^2 / D_h^2),  a = b_e = R - D_h/2.
struct AsmePinPlate {
  double clearance_factor = 1;  ///< C_r
  double tension = 0, splitting = 0, shear = 0, bearing = 0;
};
AsmePinPlate asme_pin_plate(const PadeyeFormulaInput& input);

}  // namespace blocklift::structure
