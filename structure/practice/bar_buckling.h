#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "structure/practice/column.h"
#include "structure/practice/panel_buckling.h"
#include "structure/response/elastic_model.h"

namespace blocklift::structure {

/// Piece of a bar that buckles as one.
///
/// Of a bar that stands free of plates: straight, from joint to joint; what it ends on (plates,
/// other bars, links, springs) holds it there, nothing between. Of a stiffener along a plate: from
/// one support of the plate to the next; other plates hold it, and what crosses it with five times
/// its second moment about the plate.
struct BarSpan {
  std::string bar;                                     ///< name of its region
  std::string group;                                   ///< name of that region's group
  Vector3 p_BFrom = Vector3::Zero(), p_BTo = p_BFrom;  ///< m
  double plate_width = 0;  ///< of the plate that buckles with it, m; 0: it stands free
  /// Of a stiffener: l_T, its length or the distance of its tripping brackets where that is less,
  /// m.
  double tripping_length = 0;
  /// Of a stiffener: stress at which it turns about its toe between the span's ends, or its
  /// tripping brackets, elastic and as it may bear (tripping.h), Pa; 0: it is none, or has no
  /// torsion constant.
  double tripping_stress = 0, tripping_strength = 0;
  /// As a column that is pinned at its joints; twice as long as it is where an end is free. Its
  /// axes y and z are the section's principal ones, about which it bends; of a stiffener with its
  /// plate y is the one in the plate.
  Column column;

  bool has_tripping_brackets() const {
    return tripping_length > 0 && tripping_length < column.length;
  }
};

/// The bars of a block that may buckle, and their section forces for its unit loads.
///
/// A bar is a stiffener where just two shells meet along it which go on from one another by less
/// than 30 degrees: it buckles with half of either panel (stiffener_column); its compression is its
/// own and that of these halves by their mean stress along it, its moment that of the curvature
/// which it has in the mesh. It trips by the larger compression of its centroid and of its fibre
/// farthest from the plate, where bending grows with the compression of the column: no less than
/// the mean over the section that counts, which is weighted by the square of the distance from the
/// toe (Bleich 1952, chapter 3). Other bars along plates (faces of girders, edges of brackets) are
/// left out, and rods without second moments, which are counted. Of a bar whose section changes
/// along a piece the smallest figures count.
class BlockBars {
 public:
  /// @param motions freedoms x m, m and rad; those of the panels.
  BlockBars(const ElasticModel& model, const Eigen::Ref<const Eigen::MatrixXd>& motions,
            const BlockPanels& panels);

  const std::vector<BarSpan>& spans() const { return spans_; }
  /// Rods of which nothing says how they resist bending.
  int unknown_rods() const { return unknown_rods_; }

  struct Worst {
    double utilisation = 0;  ///< column_utilisation
    ColumnForces forces;     ///< without the factor, moments about the column's axes y and z
    double share = 0;        ///< of the span's length, where that is
    int instant = 0;
  };
  /// Of a stiffener's tripping.
  struct WorstTripping {
    double utilisation = 0;  ///< compression times the factor over BarSpan::tripping_strength
    double compression = 0;  ///< with the factor, Pa
    double share = 0;
    int instant = 0;
  };
  struct WorstOfSpan {
    Worst column;
    WorstTripping tripping;  ///< utilisation 0 of spans that do not trip
  };
  /// The largest utilisations of each span over instants (a column of factors of the motions each),
  /// forces multiplied by `factor`.
  std::vector<WorstOfSpan> find_worst(const Eigen::MatrixXd& factors, double factor,
                                      int threads = 0) const;

 private:
  /// Of a span: their places, and where their rows begin in forces_: N, M_y, M_z, and of a
  /// stiffener the stresses of its centroid and its farthest fibre.
  struct Stations {
    std::vector<double> shares;
    Eigen::Index first_row = 0;
  };

  /// Calls see(place, instant, rows of the station) for a span at all places and instants.
  template <class See>
  void look_at(std::size_t span, const Eigen::MatrixXd& factors, const See& see) const;

  std::vector<BarSpan> spans_;
  std::vector<Stations> stations_;
  Eigen::MatrixXd forces_;  ///< rows of stations, a column a motion
  int unknown_rods_ = 0;
};

}  // namespace blocklift::structure
