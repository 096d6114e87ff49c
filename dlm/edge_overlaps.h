// Edges that run along each other without sharing their ends: T-junctions, edges shifted against each other, edges
// whose ends were rounded differently.
//
// Every edge is cut at the ends of others that lie on it; ends nearer to each other than the tolerance are one. Two
// edges overlap where they have a piece in common that no third edge has: what continues what is certain there only.
// What is shorter than a few tolerances has no direction and is no piece.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dlm/point_tree.h"

namespace lucarne {

struct EdgeOverlap {
  std::uint32_t a, b;   // a < b, into `edges`
  double aBegin, aEnd;  // fractions of a, aBegin < aEnd
  double bBegin, bEnd;  // of b at the same two places: bBegin > bEnd where b runs the other way
};

/// Ordered by a, b, aBegin; pieces that follow each other on both edges are one overlap. `others`: edges that only
/// count as third ones, of pieces whose middle they have. Points through which more than 16 edges pass cut none, and
/// pieces through whose middle so many pass are none: the time is n log n however many edges lie on one line.
/// Coordinates finite.
std::vector<EdgeOverlap> findEdgeOverlaps(std::span<const Segment> edges, std::span<const Segment> others,
                                          double tolerance);

}  // namespace lucarne
