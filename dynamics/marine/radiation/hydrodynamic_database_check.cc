#include <algorithm>
#include <cmath>
#include <sstream>

#include "dynamics/errors.h"
#include "dynamics/marine/radiation/hydrodynamic_database.h"

namespace blocklift::dynamics {
namespace {

/// Collects what is wrong with a database.
class Examination {
 public:
  explicit Examination(const HydrodynamicDatabase& database) : database_(database) {}

  void run() {
    water();
    bodies();
    frequencies();
    const Eigen::Index modes = database_.mode_count();
    matrix(database_.infinite_added_mass, modes, "the infinite-frequency added mass");
    if (database_.hydrostatic_stiffness.size() > 0) {
      matrix(database_.hydrostatic_stiffness, modes, "the hydrostatic stiffness");
    }
    errors(database_.change_from_coarser, modes, "changes from coarser panels");
    errors(database_.excitation_change_from_coarser, modes,
           "changes of excitation from coarser panels");
    errors(database_.cut_off_by_end, modes, "shares that the runs' end cuts off");
    series(database_.added_mass, modes, "the added mass");
    series(database_.damping, modes, "the damping");
    series(database_.froude_krylov, headings(), "the Froude-Krylov force");
    series(database_.diffraction, headings(), "the diffraction force");
    if (!database_.mean_drift.empty()) series(database_.mean_drift, headings(), "the mean drift");
    if (!database_.far_field.empty()) far_field();
    retardation();
    if (!text_.empty()) throw ModelError(text_);
  }

 private:
  Eigen::Index headings() const { return static_cast<Eigen::Index>(database_.headings.size()); }

  void complain(const std::string& what) { text_ += (text_.empty() ? "" : "\n") + what; }

  template <class... Parts>
  static std::string join(const Parts&... parts) {
    std::ostringstream text;
    ((text << parts), ...);
    return text.str();
  }

  void water() {
    const Water& water = database_.water;
    if (!(water.density > 0.0) || !(water.gravity > 0.0) || !(water.depth > 0.0) ||
        !std::isfinite(water.density) || !std::isfinite(water.gravity)) {
      complain(join("the water has a density of ", water.density, " kg/m3, a gravity of ",
                    water.gravity, " m/s2 and a depth of ", water.depth,
                    " m: all must be positive, the first two finite"));
    }
  }

  void errors(const Eigen::VectorXd& found, Eigen::Index modes, const char* what) {
    if (found.size() == 0 || found.size() == modes) return;
    complain(join("there are ", found.size(), " ", what, " for ", modes, " modes"));
  }

  void count(std::size_t found, const char* what, bool may_lack = false) {
    if (found == database_.body_names.size() || (may_lack && found == 0)) return;
    complain(join("there are ", found, " ", what, " for ", database_.body_names.size(), " bodies"));
  }

  void bodies() {
    const auto& names = database_.body_names;
    if (names.empty()) complain("there is no body");
    for (auto name = names.begin(); name != names.end(); ++name) {
      if (std::find(names.begin(), name, *name) != name) {
        complain("two bodies have the name " + *name);
      }
    }
    count(database_.reference_points.size(), "reference points");
    count(database_.displaced_volumes.size(), "displaced volumes");
    count(database_.centres_of_buoyancy.size(), "centres of buoyancy", true);
    count(database_.centres_of_mass.size(), "centres of mass", true);
    for (const auto* points : {&database_.reference_points, &database_.centres_of_buoyancy,
                               &database_.centres_of_mass}) {
      for (const Vector3& point : *points) {
        if (!point.allFinite()) complain("a point of a body is not finite");
      }
    }
    for (const double volume : database_.displaced_volumes) {
      if (!(volume >= 0.0) || !std::isfinite(volume)) {
        complain(join("a displaced volume is ", volume, " m3"));
      }
    }
  }

  void frequencies() {
    const auto& w = database_.frequencies;
    if (w.empty()) complain("there are no frequencies");
    for (std::size_t k = 0; k < w.size(); ++k) {
      if (w[k] > 0.0 && std::isfinite(w[k]) && (k == 0 || w[k] > w[k - 1])) continue;
      complain(join("frequency ", k + 1, " is ", w[k],
                    " rad/s: frequencies must be positive and ascend"));
    }
    for (std::size_t k = 0; k < database_.headings.size(); ++k) {
      if (!std::isfinite(database_.headings[k])) complain(join("heading ", k + 1, " is no number"));
    }
  }

  std::string mode(Eigen::Index index) const {
    static constexpr const char* names[] = {"surge", "sway", "heave", "roll", "pitch", "yaw"};
    const auto body = static_cast<std::size_t>(index / modes_per_body);
    const std::string name = body < database_.body_names.size() ? database_.body_names[body] : "?";
    return name + " " + names[index % modes_per_body];
  }

  /// Says where the first number is that is not finite.
  template <class Matrix>
  bool finite(const Matrix& matrix, Eigen::Index columns, const std::string& what) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
        if (std::isfinite(std::abs(matrix(i, j)))) continue;
        complain(what + " is not a number for " + mode(i) +
                 (columns == database_.mode_count() ? " by " + mode(j)
                                                    : " at heading " + std::to_string(j + 1)));
        return false;
      }
    }
    return true;
  }

  template <class Matrix>
  bool matrix(const Matrix& matrix, Eigen::Index columns, const std::string& what) {
    if (matrix.rows() != database_.mode_count() || matrix.cols() != columns) {
      complain(join(what, " is ", matrix.rows(), " x ", matrix.cols(), " where ",
                    database_.mode_count(), " x ", columns, " is due"));
      return false;
    }
    return finite(matrix, columns, what);
  }

  template <class Matrix>
  void series(const std::vector<Matrix>& matrices, Eigen::Index columns, const char* what) {
    if (matrices.size() != database_.frequencies.size()) {
      complain(join(what, " is given for ", matrices.size(), " of ", database_.frequencies.size(),
                    " frequencies"));
      return;
    }
    for (std::size_t k = 0; k < matrices.size(); ++k) {
      if (!matrix(matrices[k], columns, join(what, " at ", database_.frequencies[k], " rad/s")))
        return;
    }
  }

  void far_field() {
    const FarField& far = database_.far_field;
    const auto fits = [&](const std::vector<Eigen::MatrixXcd>& waves, Eigen::Index columns) {
      if (waves.size() != database_.frequencies.size()) return false;
      return std::all_of(waves.begin(), waves.end(), [&](const Eigen::MatrixXcd& matrix) {
        return matrix.rows() == static_cast<Eigen::Index>(far.directions.size()) &&
               matrix.cols() == columns && matrix.allFinite();
      });
    };
    if (far.directions.size() % 2 == 0 || !fits(far.radiated, database_.mode_count()) ||
        !fits(far.scattered, headings())) {
      complain("the far field does not fit the frequencies, modes and headings, or is not finite");
    }
  }

  void retardation() {
    if (database_.retardation.size() < 2) {
      complain("there are no retardation functions");
      return;
    }
    if (!(database_.time_step > 0.0) || !std::isfinite(database_.time_step)) {
      complain(join("the time step of the retardation functions is ", database_.time_step, " s"));
    }
    for (std::size_t n = 0; n < database_.retardation.size(); ++n) {
      if (!matrix(database_.retardation[n], database_.mode_count(),
                  join("sample ", n + 1, " of the retardation functions")))
        return;
    }
  }

  const HydrodynamicDatabase& database_;
  std::string text_;
};

}  // namespace

void require_sound(const HydrodynamicDatabase& database) { Examination(database).run(); }

}  // namespace blocklift::dynamics
