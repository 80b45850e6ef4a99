// When a record of the position is due, and when it no longer holds.
#include "position_keeper.h"

namespace machine {
namespace {

const uint16_t kLookMs = 10;     // between two looks at the encoders
const uint16_t kStillMs = 200;   // without a count, before a motor counts as standing still
const int32_t kStillCounts = 1;  // a motor at rest may toggle a single edge
const int32_t kKeptCounts = 12;  // 0.1 mm of chain

}  // namespace

void PositionKeeper::begin(settings::Known known) {
  const bool at_rest = known == settings::Known::kAtRest;
  const bool was_set = known != settings::Known::kNothing;
  // Nothing says which axis moved, so z may be anywhere too.
  lost_ = at_rest ? uint8_t(0) : was_set ? uint8_t(kLostChains | kLostZ) : uint8_t(kUnset);
  state_ = at_rest ? State::kKept : State::kSettling;
  takeCounts();
}

void PositionKeeper::doubt(Axis axis, settings::Doubt why) {
  lost_ = uint8_t(lost_ | (axis == kZAxis ? kLostZ : kLostChains));
  if (!axes_.isSimulated()) memory_.doubtPosition(why);
}

void PositionKeeper::declareChains() {
  lost_ = uint8_t(lost_ & kLostZ);
  if (!axes_.isSimulated()) memory_.endDoubt();
  reconsider();
}

void PositionKeeper::declareZ() {
  lost_ = uint8_t(lost_ & ~kLostZ);
  reconsider();
}

void PositionKeeper::reconsider() {
  if (lost_ == 0 && state_ != State::kAboutToMove) leaveRecord(State::kSettling);
}

void PositionKeeper::beginMoving() { leaveRecord(State::kAboutToMove); }

void PositionKeeper::leaveRecord(State next) {
  if (!axes_.isSimulated()) memory_.beginMoving();
  state_ = next;
}

void PositionKeeper::takeCounts() {
  for (uint8_t i = 0; i < kAxisCount; ++i) counts_[i] = axes_.counts(Axis(i));
}

int32_t PositionKeeper::farthestFromCounts() const {
  int32_t farthest = 0;
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    const int32_t moved = axes_.counts(Axis(i)) - counts_[i];
    if (moved > farthest) farthest = moved;
    if (-moved > farthest) farthest = -moved;
  }
  return farthest;
}

bool PositionKeeper::isDue(uint32_t now_ms) {
  const uint16_t now = uint16_t(now_ms);
  if (axes_.isSimulated() || uint16_t(now - looked_ms_) < kLookMs) return false;
  looked_ms_ = now;
  if (axes_.isPowered()) {
    if (state_ != State::kInMotion) leaveRecord(State::kInMotion);
    return false;
  }
  if (state_ == State::kAboutToMove) return false;
  if (state_ == State::kKept) {
    if (farthestFromCounts() > kKeptCounts) leaveRecord(State::kSettling);
    return false;
  }
  if (state_ == State::kSettling && farthestFromCounts() <= kStillCounts)
    return lost_ == 0 && uint16_t(now - still_since_ms_) >= kStillMs;
  state_ = State::kSettling;
  takeCounts();
  still_since_ms_ = now;
  return false;
}

void PositionKeeper::keep(const settings::Position& position) {
  memory_.keepPosition(position);
  state_ = State::kKept;
}

}  // namespace machine
