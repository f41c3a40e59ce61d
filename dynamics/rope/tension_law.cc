#include "dynamics/rope/tension_law.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include "dynamics/errors.h"

namespace blocklift::dynamics {

namespace {

// Chords of one line differ by rounding.
constexpr double slope_rounding = 1e-9;

std::vector<double> slopes_of_chords(const std::vector<TensionPoint>& points) {
  if (points.size() < 2 || points.front().strain != 0.0 || points.front().tension != 0.0)
    throw ModelError(
        "a curve of tension over strain begins at no strain and no tension, and has "
        "two points or more");
  std::vector<double> slopes;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double along = points[i].strain - points[i - 1].strain;
    const double rise = points[i].tension - points[i - 1].tension;
    if (!(along > 0.0) || !(rise > 0.0) || !std::isfinite(rise / along))
      throw ModelError(
          "a curve of tension over strain must rise from one point to the next; point " +
          std::to_string(i + 1) + " does not");
    slopes.push_back(rise / along);
    if (i > 1 && slopes[i - 1] < (1.0 - slope_rounding) * slopes[i - 2])
      throw ModelError(
          "a curve of tension over strain must grow steeper or stay as steep; it is "
          "less steep up to point " +
          std::to_string(i + 1) + " than before");
  }
  return slopes;
}

bool equal(double slope, double other) {
  return std::abs(slope - other) <= slope_rounding * std::abs(other);
}

std::vector<double> slopes_at_points(const std::vector<double>& chords) {
  const std::size_t last = chords.size();
  const auto is_straight = [&](std::size_t i) {
    return (i > 0 && equal(chords[i], chords[i - 1])) ||
           (i + 1 < last && equal(chords[i], chords[i + 1]));
  };
  std::vector<double> slopes(last + 1, chords.front());
  if (last == 1) return slopes;
  for (std::size_t i = 1; i < last; ++i) {
    const double before = chords[i - 1], behind = chords[i];
    slopes[i] = 2.0 * before * behind / (before + behind);
    if (is_straight(i - 1) != is_straight(i)) slopes[i] = is_straight(i) ? behind : before;
  }
  slopes.front() = chords.front() * chords.front() / slopes[1];
  slopes.back() = chords.back() * chords.back() / slopes[last - 1];
  return slopes;
}

}  // namespace

TensionLaw::TensionLaw(const std::vector<TensionPoint>& points) {
  const std::vector<double> chords = slopes_of_chords(points);
  const std::vector<double> slopes = slopes_at_points(chords);
  pieces_.push_back({.strain = -std::numeric_limits<double>::infinity()});
  pieces_.push_back({});
  for (std::size_t i = 0; i < chords.size(); ++i) {
    const double length = points[i + 1].strain - points[i].strain;
    const double a = slopes[i], chord = chords[i], b = slopes[i + 1];
    // The area below both lines of the slope is that below the chord.
    if (equal(a, chord) && equal(b, chord)) {
      add_piece(a, b, length);
    } else if (a < chord && chord < b) {
      const double knot = length * (b - chord) / (b - a);
      add_piece(a, chord, knot);
      add_piece(chord, b, length - knot);
    } else {
      const double middle = 2.0 * chord - 0.5 * (a + b);
      add_piece(a, middle, 0.5 * length);
      add_piece(middle, b, 0.5 * length);
    }
    // The end of the chord is the point itself, not what rounding makes of it.
    pieces_.back().strain = points[i + 1].strain;
    pieces_.back().tension = points[i + 1].tension;
  }
  pieces_.back().slope = slopes.back();
  pieces_.front() = pieces_[1];
  pieces_.front().curvature = 0.0;
}

// Ends the last piece, whose slope goes from one to the other, and begins the next there.
void TensionLaw::add_piece(double slope, double end_slope, double length) {
  Piece& piece = pieces_.back();
  piece.slope = slope;
  piece.curvature = length > 0.0 ? (end_slope - slope) / length : 0.0;
  const double x = length, c = piece.curvature;
  const Piece next{.strain = piece.strain + x,
                   .tension = piece.tension + x * (slope + 0.5 * c * x),
                   .energy = piece.energy + x * (piece.tension + x * (slope / 2.0 + c * x / 6.0))};
  pieces_.push_back(next);
}

const TensionLaw::Piece& TensionLaw::piece_at(double strain) const {
  std::size_t i = pieces_.size() - 1;
  while (i > 1 && strain < pieces_[i].strain) --i;
  return strain < 0.0 ? pieces_.front() : pieces_[i];
}

double TensionLaw::tension(double strain) const {
  const Piece& p = piece_at(strain);
  const double x = strain - p.strain;
  return p.tension + x * (p.slope + 0.5 * p.curvature * x);
}

double TensionLaw::slope(double strain) const {
  const Piece& p = piece_at(strain);
  return p.slope + p.curvature * (strain - p.strain);
}

double TensionLaw::curvature(double strain) const { return piece_at(strain).curvature; }

double TensionLaw::strain_energy(double strain) const {
  const Piece& p = piece_at(strain);
  const double x = strain - p.strain;
  return p.energy + x * (p.tension + x * (p.slope / 2.0 + p.curvature * x / 6.0));
}

double TensionLaw::find_strain(double elongation, double length, double compliance) const {
  const auto of = [&](const Piece& p) { return length * p.strain + compliance * p.tension; };
  std::size_t i = pieces_.size() - 1;
  while (i > 1 && elongation < of(pieces_[i])) --i;
  const Piece& p = elongation < 0.0 ? pieces_.front() : pieces_[i];
  // compliance curvature x^2 / 2 + (length + compliance slope) x = what is left, x >= 0.
  const double left = elongation - of(p);
  const double b = length + compliance * p.slope;
  const double root = std::sqrt(std::max(0.0, b * b + 2.0 * compliance * p.curvature * left));
  return p.strain + 2.0 * left / (b + root);
}

}  // namespace blocklift::dynamics
