// Where a path crosses the lines of the area's edges, and the pieces between.
#include "edge_cut.h"

namespace machine {

using motion::Path;
using motion::Point;

EdgeCut::EdgeCut(const Path<float>& path, const Area& area)
    : path_(path), area_(area), here_(area.clamped(path.from)) {
  shares_[0] = 1;
  if (path.drawn != motion::Drawn::kYes || area.holds(path)) return;
  if (path.sweep == 0)
    cutLine();
  else
    cutArc();
  for (uint8_t i = 0; i <= cuts_; ++i) leaves_ = leaves_ || !isInside(i);
  if (leaves_) return;
  cuts_ = 0;
  shares_[0] = 1;
}

bool EdgeCut::next() {
  if (at_ == cuts_) return false;
  ++at_;
  if (!leaves_) {
    piece_ = path_;
    return true;
  }
  // A shorter piece of an arc has no clear direction around its centre.
  const float kLeast = 0.01f;  // [mm]
  const Point<float> from = here_;
  const float share = shares_[at_] - (at_ == 0 ? 0 : shares_[at_ - 1]);
  here_ = area_.clamped(motion::placeOn(path_, shares_[at_]));
  const bool is_round = path_.sweep != 0 && isInside(at_) && share * path_.length > kLeast;
  const motion::Turn turn =
      path_.sweep > 0 ? motion::Turn::kCounterclockwise : motion::Turn::kClockwise;
  piece_ = is_round ? motion::arc(from, here_, path_.centre, turn, 0) : motion::line(from, here_);
  return true;
}

void EdgeCut::cutLine() {
  const float x = path_.to.x - path_.from.x, y = path_.to.y - path_.from.y;
  if (x != 0) {
    cutAt((area_.low.x - path_.from.x) / x);
    cutAt((area_.high.x - path_.from.x) / x);
  }
  if (y != 0) {
    cutAt((area_.low.y - path_.from.y) / y);
    cutAt((area_.high.y - path_.from.y) / y);
  }
}

void EdgeCut::cutArc() {
  const Point<float>& centre = path_.centre;
  const float edges[] = {area_.low.x - centre.x, area_.high.x - centre.x, area_.low.y - centre.y,
                         area_.high.y - centre.y};
  for (uint8_t i = 0; i < 4; ++i) {
    const float cosine = edges[i] / path_.radius;
    if (!(float(fabs(cosine)) < 1)) continue;
    const float quarter = 1.5707963f, half_chord = float(acos(cosine));
    const float middle = i < 2 ? 0 : quarter;
    cutAngle(middle + half_chord);
    cutAngle(middle - half_chord);
  }
}

/// Cuts an arc at an angle [rad] around its centre.
void EdgeCut::cutAngle(float angle) {
  const float full_turn = 6.2831853f;
  const float first = float(atan2(path_.from.y - path_.centre.y, path_.from.x - path_.centre.x));
  float turned = path_.sweep > 0 ? angle - first : first - angle;
  while (turned < 0) turned += full_turn;
  while (turned >= full_turn) turned -= full_turn;
  cutAt(turned / float(fabs(path_.sweep)));
}

/// Adds a cut at a share of the path, in order.
void EdgeCut::cutAt(float share) {
  if (!(share > 0 && share < 1)) return;
  uint8_t at = ++cuts_;
  for (; at > 0 && shares_[at - 1] > share; --at) shares_[at] = shares_[at - 1];
  shares_[at] = share;
}

bool EdgeCut::isInside(uint8_t index) const {
  const float kSlack = 0.002f;  // [mm] of a path along the edge
  const float before = index == 0 ? 0 : shares_[index - 1];
  return area_.nearlyHolds(motion::placeOn(path_, 0.5f * (before + shares_[index])), kSlack);
}

}  // namespace machine
