#include "dynamics/marine/hull/hull_shapes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "dynamics/errors.h"

namespace blocklift::dynamics {

namespace {

// A hull is the skin of a bent box of nx x ny x nz cells: point (i, j, k) lies at the station i,
// the fraction j / ny of the breadth from starboard to port, and the row k from the bottom to the
// deck. A row gives x, the half-breadth (in y) and z.
using RowPoint = std::function<Vector3(int station, int row)>;

class BoxSkin {
 public:
  BoxSkin(std::string name, int nx, int ny, int nz, RowPoint row)
      : hull_(std::move(name)), n_{nx, ny, nz}, row_(std::move(row)) {}

  // Coinciding vertices (stems, keels) are merged, what has no area left disappears.
  Hull build(double tolerance) {
    for (int i = 0; i <= n_[0]; ++i) {
      for (int j = 0; j <= n_[1]; ++j) {
        for (int k = 0; k <= n_[2]; ++k) number_.push_back(add_if_outer(i, j, k));
      }
    }
    for (int a = 0; a < n_[0]; ++a) {
      for (int b = 0; b < n_[1]; ++b) {
        add({a, b, 0}, {a, b + 1, 0}, {a + 1, b + 1, 0}, {a + 1, b, 0});
        add({a, b, n_[2]}, {a + 1, b, n_[2]}, {a + 1, b + 1, n_[2]}, {a, b + 1, n_[2]});
      }
      for (int c = 0; c < n_[2]; ++c) {
        add({a, 0, c}, {a + 1, 0, c}, {a + 1, 0, c + 1}, {a, 0, c + 1});
        add({a, n_[1], c}, {a, n_[1], c + 1}, {a + 1, n_[1], c + 1}, {a + 1, n_[1], c});
      }
    }
    for (int b = 0; b < n_[1]; ++b) {
      for (int c = 0; c < n_[2]; ++c) {
        add({0, b, c}, {0, b, c + 1}, {0, b + 1, c + 1}, {0, b + 1, c});
        add({n_[0], b, c}, {n_[0], b + 1, c}, {n_[0], b + 1, c + 1}, {n_[0], b, c + 1});
      }
    }
    return without_flat_panels(merge_vertices(hull_, tolerance));
  }

 private:
  using Place = std::array<int, 3>;

  int add_if_outer(int i, int j, int k) {
    const bool outer = i == 0 || i == n_[0] || j == 0 || j == n_[1] || k == 0 || k == n_[2];
    if (!outer) return -1;
    const Vector3 row = row_(i, k);
    const double fraction = 2.0 * j / n_[1] - 1.0;
    return hull_.add_vertex({row.x(), fraction * row.y(), row.z()});
  }
  int number(const Place& p) const {
    const int place = (p[0] * (n_[1] + 1) + p[1]) * (n_[2] + 1) + p[2];
    return number_[place];
  }
  void add(const Place& a, const Place& b, const Place& c, const Place& d) {
    hull_.add_panel({number(a), number(b), number(c), number(d)});
  }

  // Panels that are folded onto themselves (both halves of an end that has become a line).
  static Hull without_flat_panels(const Hull& hull) {
    Hull kept(hull.name());
    for (const Vector3& p : hull.vertices()) kept.add_vertex(p);
    for (int panel = 0; panel < hull.panel_count(); ++panel) {
      const double diameter = hull.panel_diameter(panel);
      if (hull.panel_area_vector(panel).norm() > 1e-9 * diameter * diameter) {
        kept.add_panel(hull.panel(panel));
      }
    }
    return kept;
  }

  Hull hull_;
  std::array<int, 3> n_;
  RowPoint row_;
  std::vector<int> number_;
};

void require_positive(const std::string& name, const char* what, double value) {
  if (std::isfinite(value) && value > 0.0) return;
  throw ModelError("hull \"" + name + "\" has the " + what + " " + std::to_string(value) +
                   "; a number above zero is due");
}

void require_between(const std::string& name, const char* what, double value, double low,
                     double high) {
  if (value >= low && value <= high) return;
  throw ModelError("hull \"" + name + "\" has the " + what + " " + std::to_string(value) +
                   "; it must lie between " + std::to_string(low) + " and " + std::to_string(high));
}

void require_division(const std::string& name, const PanelDivision& d) {
  if (d.along >= 1 && d.across >= 1 && d.upright >= 1 && d.bilge >= 1) return;
  throw ModelError("hull \"" + name + "\" is divided into " + std::to_string(d.along) + " x " +
                   std::to_string(d.across) + " x " + std::to_string(d.upright) + " panels, and " +
                   std::to_string(d.bilge) + " round a bilge; each number must be one or more");
}

// Stations at all given places and, between them, evenly at most `size` apart.
std::vector<double> stations_through(std::vector<double> places, double size) {
  std::sort(places.begin(), places.end());
  const double least = 1e-9 * (places.back() - places.front());
  std::vector<double> stations = {places.front()};
  for (const double place : places) {
    const double from = stations.back();
    if (place - from <= least) continue;
    const int count = std::max(1, static_cast<int>(std::ceil((place - from) / size - 1e-9)));
    for (int i = 1; i <= count; ++i) stations.push_back(from + (place - from) * i / count);
  }
  return stations;
}

}  // namespace

PanelDivision PanelDivision::of_size(double size, double length, double breadth, double depth) {
  if (!(size > 0.0) || !std::isfinite(size)) {
    throw ModelError("the panel size is " + std::to_string(size) +
                     " m; a number above zero is due");
  }
  const auto count = [size](double extent) {
    return std::max(1, static_cast<int>(std::ceil(extent / size - 1e-9)));
  };
  return {count(length), count(breadth), count(depth), 3};
}

namespace {

void require_barge(const std::string& name, const BargeShape& s) {
  require_positive(name, "length", s.length);
  require_positive(name, "breadth", s.breadth);
  require_positive(name, "depth", s.depth);
  require_between(name, "bow rake length", s.bow_rake_length, 0.0, s.length);
  require_between(name, "stern rake length", s.stern_rake_length, 0.0,
                  s.length - s.bow_rake_length);
  require_between(name, "bow rake height", s.bow_rake_height, 0.0, 0.999 * s.depth);
  require_between(name, "stern rake height", s.stern_rake_height, 0.0, 0.999 * s.depth);
  const double highest = std::max(s.bow_rake_height, s.stern_rake_height);
  require_between(name, "bilge radius", s.bilge_radius, 0.0,
                  std::min(s.depth - highest, 0.5 * s.breadth - s.corner_breadth));
  require_between(name, "corner length", s.corner_length, 0.0, 0.5 * s.length);
  require_between(name, "corner breadth", s.corner_breadth, 0.0, 0.499 * s.breadth);
}

// Height of the bottom above the base line.
double bottom_height(const BargeShape& s, double x) {
  const double bow = x - (0.5 * s.length - s.bow_rake_length);
  const double stern = -x - (0.5 * s.length - s.stern_rake_length);
  if (bow > 0.0) return s.bow_rake_height * bow / s.bow_rake_length;
  if (stern > 0.0) return s.stern_rake_height * stern / s.stern_rake_length;
  return 0.0;
}

double half_breadth(const BargeShape& s, double x) {
  const double into_corner = std::abs(x) - (0.5 * s.length - s.corner_length);
  if (!(into_corner > 0.0)) return 0.5 * s.breadth;
  return 0.5 * s.breadth - s.corner_breadth * into_corner / s.corner_length;
}

}  // namespace

Hull make_barge(const BargeShape& s, const PanelDivision& division, std::string name) {
  require_barge(name, s);
  require_division(name, division);
  const double half = 0.5 * s.length;
  const std::vector<double> stations =
      stations_through({-half, -half + s.stern_rake_length, -half + s.corner_length,
                        half - s.corner_length, half - s.bow_rake_length, half},
                       s.length / division.along);
  const int bilge = s.bilge_radius > 0.0 ? division.bilge : 0;
  const auto row = [&](int station, int k) -> Vector3 {
    const double x = stations[station];
    const double bottom = bottom_height(s, x);
    const double breadth = half_breadth(s, x);
    const double r = s.bilge_radius;
    if (k < bilge) {
      const double angle = 0.5 * std::numbers::pi * k / bilge;
      return {x, breadth - r * (1.0 - std::sin(angle)), bottom + r * (1.0 - std::cos(angle))};
    }
    const double fraction = static_cast<double>(k - bilge) / division.upright;
    return {x, breadth, bottom + r + fraction * (s.depth - bottom - r)};
  };
  return BoxSkin(std::move(name), static_cast<int>(stations.size()) - 1, division.across,
                 bilge + division.upright, row)
      .build(1e-9 * s.length);
}

namespace {

void require_ship(const std::string& name, const ShipShape& s) {
  require_positive(name, "length", s.length);
  require_positive(name, "breadth", s.breadth);
  require_positive(name, "depth", s.depth);
  require_between(name, "draught", s.draught, 1e-6 * s.depth, 0.999 * s.depth);
  require_between(name, "bow length", s.bow_length, 0.0, s.length);
  require_between(name, "stern length", s.stern_length, 0.0, s.length - s.bow_length);
  require_between(name, "transom breadth", s.transom_breadth, 0.0, s.breadth);
  require_between(name, "bow exponent", s.bow_exponent, 0.5, 50.0);
  require_between(name, "stern exponent", s.stern_exponent, 0.5, 50.0);
  require_between(name, "midship section exponent", s.midship_section_exponent, 1.0, 50.0);
  require_between(name, "bow section exponent", s.bow_section_exponent, 1.0, 50.0);
  require_between(name, "stern section exponent", s.stern_section_exponent, 1.0, 50.0);
}

// Half-breadth of a ship at the station x and the fraction zeta of the draught.
double half_breadth(const ShipShape& s, double x, double zeta) {
  const double forward = x - (0.5 * s.length - s.bow_length);
  const double aft = -x - (0.5 * s.length - s.stern_length);
  double water_line = 1.0;
  double exponent = s.midship_section_exponent;
  if (forward > 0.0) {
    const double xi = std::min(1.0, forward / s.bow_length);
    water_line = 1.0 - std::pow(xi, s.bow_exponent);
    exponent += (s.bow_section_exponent - exponent) * xi;
  } else if (aft > 0.0) {
    const double xi = std::min(1.0, aft / s.stern_length);
    water_line = 1.0 - (1.0 - s.transom_breadth / s.breadth) * std::pow(xi, s.stern_exponent);
    exponent += (s.stern_section_exponent - exponent) * xi;
  }
  const double section =
      zeta >= 1.0 ? 1.0 : std::pow(1.0 - std::pow(1.0 - zeta, exponent), 1.0 / exponent);
  return 0.5 * s.breadth * water_line * section;
}

// Heights of the rows: fine in the lowest third of the draught, then even up to the deck.
std::vector<double> ship_rows(double depth, double draught, const PanelDivision& division) {
  std::vector<double> rows;
  for (int i = 0; i < division.bilge; ++i) {
    const double fraction = static_cast<double>(i) / division.bilge;
    rows.push_back(draught / 3.0 * fraction * fraction);
  }
  const double size = depth / division.upright;
  const std::vector<double> upper = stations_through({draught / 3.0, draught, depth}, size);
  rows.insert(rows.end(), upper.begin(), upper.end());
  return rows;
}

}  // namespace

Hull make_ship(const ShipShape& s, const PanelDivision& division, std::string name) {
  require_ship(name, s);
  require_division(name, division);
  const double half = 0.5 * s.length;
  const std::vector<double> stations = stations_through(
      {-half, -half + s.stern_length, half - s.bow_length, half}, s.length / division.along);
  const std::vector<double> rows = ship_rows(s.depth, s.draught, division);
  const auto row = [&](int station, int k) -> Vector3 {
    const double x = stations[station];
    const double z = rows[k];
    return {x, half_breadth(s, x, z / s.draught), z};
  };
  return BoxSkin(std::move(name), static_cast<int>(stations.size()) - 1, division.across,
                 static_cast<int>(rows.size()) - 1, row)
      .build(1e-7 * s.length);
}

Hull make_wigley(double length, double breadth, double draught, double freeboard,
                 const PanelDivision& division, std::string name) {
  require_positive(name, "length", length);
  require_positive(name, "breadth", breadth);
  require_positive(name, "draught", draught);
  require_positive(name, "freeboard", freeboard);
  require_division(name, division);
  const int below = division.upright;
  const auto row = [&](int station, int k) -> Vector3 {
    const double xi = 2.0 * station / division.along - 1.0;
    const double z = k <= below ? -draught * (1.0 - static_cast<double>(k) / below) : freeboard;
    const double zeta = std::min(0.0, z / draught);
    return {0.5 * length * xi, 0.5 * breadth * (1.0 - xi * xi) * (1.0 - zeta * zeta), z};
  };
  return BoxSkin(std::move(name), division.along, division.across, below + 1, row)
      .build(1e-7 * length);
}

Hull make_box(const Vector3& size, const PanelDivision& division, std::string name) {
  const Hull barge = make_barge({.length = size.x(), .breadth = size.y(), .depth = size.z()},
                                division, std::move(name));
  return transform(Pose::translation({0.0, 0.0, -0.5 * size.z()}), barge);
}

}  // namespace blocklift::dynamics
