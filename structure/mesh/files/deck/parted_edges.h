#pragma once

#include <limits>
#include <map>
#include <string>
#include <utility>

#include "structure/mesh/files/deck/log.h"

namespace blocklift::structure {

/// What a deck has in the middle of an edge of a quadratic element.
struct GivenMiddle {
  int from = 0, to = 0;  ///< vertices at the edge's ends
  int vertex = 0;        ///< in its middle
  long element = 0;      ///< number of the element
  std::string card;      ///< or keyword, for messages
  SourceLine line;
};

/// PartedEdges::apart of shells: two that lie on one line, not the halves of a pipe.
constexpr double apart_of_shells = 0.05;

/// Complains of edges whose middle is one node in one element and another in the next, so that the
/// elements would part between the ends of the edge.
class PartedEdges {
 public:
  /// @param mesh with the vertices' numbers and places; it and the log outlive this object.
  /// @param apart share of an edge beyond which middles are those of two edges between the same
  /// nodes, and no fault
  PartedEdges(const Mesh& mesh, DeckLog& log,
              double apart = std::numeric_limits<double>::infinity())
      : mesh_(mesh), log_(log), apart_(apart) {}

  void take(const GivenMiddle& middle);

 private:
  struct Known {
    int vertex = 0;
    long element = 0;  ///< the first that names it
    SourceLine line;
  };
  long label(int vertex) const;

  const Mesh& mesh_;
  DeckLog& log_;
  double apart_;
  std::multimap<std::pair<int, int>, Known> known_;  // by ends
  int count_ = 0;
};

}  // namespace blocklift::structure
