// The path of a move over the sheet: a straight line or an arc of a circle.
#pragma once

#include <math.h>
#include <stdint.h>

#include "point.h"

namespace motion {

/// Whether a path could be drawn.
enum class Drawn : uint8_t {
  kYes,
  kNoNumber,   ///< NaN, or too far away for a float
  kNoLength,   ///< it ends where it begins, and is no full circle
  kEndOffArc,  ///< start and end lie on different circles around the centre
};

/// Which way round its centre an arc goes, seen from the front of the sheet.
enum class Turn : uint8_t { kClockwise, kCounterclockwise };

// An arc's start, end and centre come as decimal text, each rounded by itself. So its two radii may
// differ by as much as in LinuxCNC (two roundings of inches with three decimals) or in Grbl (a
// share of the radius). The arc changes evenly from its first radius to its last.
const float kMostOffArc = 0.0719f;      // [mm]
const float kMostOffArcShare = 0.001f;  // [1] of the radius, where that is more

// The last digit of text with few decimals: it places an arc's ends no better than this.
const float kMillimetreDigit = 0.01f;  // [mm] two decimals
const float kInchDigit = 0.0254f;      // [mm] three decimals

/// A path between two places; line() and arc() make it.
template <class Real>
struct Path {
  Drawn drawn;
  Point<Real> from, to;  ///< [mm]
  Point<Real> centre;    ///< [mm] of an arc
  Real sweep;            ///< [rad] angle of an arc, counterclockwise positive; zero: a line
  Real grows;            ///< [mm] radius at an arc's end less radius at its start
  Real radius;           ///< [mm] mean radius of an arc
  Real length;           ///< [mm] along the path

  /// [1/mm] Zero for a line.
  Real curvature() const { return sweep == Real(0) ? Real(0) : Real(1) / radius; }
};

namespace path_detail {

template <class Real>
Real distance(Point<Real> a, Point<Real> b) {
  const Real dx = a.x - b.x, dy = a.y - b.y;
  return sqrt(dx * dx + dy * dy);
}

/// Angle [rad] from start to end of an arc; a full turn if both are the same place.
template <class Real>
Real sweepOf(Point<Real> from, Point<Real> to, Point<Real> centre, Turn turn) {
  const Real kFullTurn = Real(6.283185307179586);
  const bool left_round = turn == Turn::kCounterclockwise;
  if (from.x == to.x && from.y == to.y) return left_round ? kFullTurn : -kFullTurn;
  const Point<Real> start = {from.x - centre.x, from.y - centre.y};
  const Point<Real> end = {to.x - centre.x, to.y - centre.y};
  // The cross product takes the chord, not the end, so that short arcs keep their sign.
  const Real cross = start.x * (to.y - from.y) - start.y * (to.x - from.x);
  const Real angle = atan2(cross, start.x * end.x + start.y * end.y);
  if (left_round) return angle > Real(0) ? angle : angle + kFullTurn;
  return angle < Real(0) ? angle : angle - kFullTurn;
}

/// Whether an arc is too short to be told from its chord in text with this last digit [mm].
///
/// A full circle may be a short arc whose ends were rounded to the same place. An arc of nearly a
/// full turn may be a short arc whose ends were rounded past each other. If the radii differ by
/// that much, the centre is unknown.
template <class Real>
bool isHidden(Real chord, Real radius, Real off, Real sweep, Real digit) {
  const Real kHalfTurn = Real(3.141592653589793), kDiagonal = Real(1.41421356);
  if (off * Real(1.5) > radius) return true;
  if (chord == Real(0)) return radius <= Real(2) * kDiagonal * digit;
  return chord <= kDiagonal * digit && Real(fabs(sweep)) > kHalfTurn;
}

/// Place on an arc: its start turned about the centre, and farther out by a share of `grows`.
template <class Real>
Point<Real> onArc(const Path<Real>& path, Real share) {
  const Real x = path.from.x - path.centre.x, y = path.from.y - path.centre.y;
  const Real start_radius = path.radius - path.grows * Real(0.5);
  const Real scale = Real(1) + path.grows * share / start_radius;
  const Real turned = path.sweep * share;
  const Real along = scale * cos(turned), across = scale * sin(turned);
  return {path.centre.x + x * along - y * across, path.centre.y + x * across + y * along};
}

}  // namespace path_detail

/// A straight line between two places [mm].
template <class Real>
Path<Real> line(Point<Real> from, Point<Real> to) {
  const Real length = path_detail::distance(from, to);
  Drawn drawn = Drawn::kYes;
  if (!isfinite(length))
    drawn = Drawn::kNoNumber;
  else if (!(length > Real(0)))
    drawn = Drawn::kNoLength;
  return {drawn, from, to, from, Real(0), Real(0), Real(0), length};
}

/// An arc around a centre [mm]; a full circle if it ends where it begins. An arc that the last
/// digit [mm] of its text hides is drawn as a line.
template <class Real>
Path<Real> arc(Point<Real> from, Point<Real> to, Point<Real> centre, Turn turn,
               float digit = kMillimetreDigit) {
  const Real start_radius = path_detail::distance(from, centre);
  const Real end_radius = path_detail::distance(to, centre);
  const Real radius = (start_radius + end_radius) * Real(0.5);
  const Real sweep = path_detail::sweepOf(from, to, centre, turn);
  const Real grows = end_radius - start_radius;
  const Real off = fabs(grows), round = radius * sweep;
  const Real length = sqrt(round * round + grows * grows);
  Drawn drawn = Drawn::kYes;
  if (!isfinite(length))
    drawn = Drawn::kNoNumber;
  else if (!(off <= Real(kMostOffArc) || off <= radius * Real(kMostOffArcShare)))
    drawn = Drawn::kEndOffArc;
  else if (path_detail::isHidden(path_detail::distance(from, to), radius, off, sweep, Real(digit)))
    return line(from, to);
  return {drawn, from, to, centre, sweep, grows, radius, length};
}

/// Place [mm] at a share [1] of the path's length: 0 is exactly its start, 1 exactly its end.
template <class Real>
Point<Real> placeOn(const Path<Real>& path, Real share) {
  if (share >= Real(1)) return path.to;
  if (path.sweep != Real(0)) return path_detail::onArc(path, share);
  return {path.from.x + (path.to.x - path.from.x) * share,
          path.from.y + (path.to.y - path.from.y) * share};
}

/// Lower bound for the distance [mm] between a path and a place.
///
/// For a line it is the distance. An arc is at least as far from the place as its circle, and any
/// path at least (start's distance + end's distance - length) / 2.
template <class Real>
Real clearance(const Path<Real>& path, Point<Real> place) {
  const Real from = path_detail::distance(path.from, place);
  const Real to = path_detail::distance(path.to, place);
  const Real by_ends = (from + to - path.length) * Real(0.5);
  if (path.sweep != Real(0)) {
    const Real by_circle = fabs(path_detail::distance(path.centre, place) - path.radius) -
                           fabs(path.grows) * Real(0.5);
    return by_circle > by_ends ? by_circle : by_ends;
  }
  const Real ex = (path.to.x - path.from.x) / path.length;
  const Real ey = (path.to.y - path.from.y) / path.length;
  const Real px = place.x - path.from.x, py = place.y - path.from.y;
  const Real along = px * ex + py * ey;
  if (along > Real(0) && along < path.length) return fabs(py * ex - px * ey);
  return from < to ? from : to;
}

}  // namespace motion
