// Knowledge of the machine's position. Nothing else stores it.
#pragma once

#include <Settings.h>

#include "axes.h"

namespace machine {

/// Keeps the position's record in the EEPROM.
///
/// A record at rest is valid only while all motors are without power and stand still, and their
/// encoders still show the counts of the record. Before anything changes a length, be it a motor or
/// a declaration, the record becomes a record of motion. A new record is due once everything has
/// stood still for a moment. A doubtful position is never stored. Simulated motion (B99 ON) leaves
/// the record alone.
class PositionKeeper {
 public:
  PositionKeeper(settings::Memory& memory, const Axes& axes) : memory_(memory), axes_(axes) {}

  /// To be called after the start, once the axes have the counts of the record.
  void begin(settings::Known known);

  /// Whether the lengths of both chains can be trusted.
  bool trustsChains() const { return (lost_ & (kLostChains | kUnset)) == 0; }
  /// Whether the lengths of both chains and z can be trusted.
  bool trustsAll() const { return lost_ == 0; }
  /// Whether the length of an axis can be trusted.
  bool trusts(Axis axis) const {
    return axis == kZAxis ? (lost_ & (kLostZ | kUnset)) == 0 : trustsChains();
  }
  /// Whether a length that was known is no longer known.
  bool hasLost() const { return (lost_ & (kLostChains | kLostZ)) != 0; }

  /// The counts of an axis were proved wrong: stores nothing until it is declared.
  void doubt(Axis axis, settings::Doubt why);
  /// The position was never known, or was erased: there is no record.
  void startAfresh() { lost_ = kUnset; }

  /// The lengths of the chains were declared: they are trusted again.
  void declareChains();
  /// The height of z was declared: it is trusted again.
  void declareZ();
  /// Lengths stay, but now counts mean other lengths, or the chains mean another place.
  void reconsider();

  /// Whether no motor has power, nor is about to get it.
  bool isReleased() const { return !axes_.isPowered() && state_ != State::kAboutToMove; }

  /// To be called before motors get power; then wait for mayMove().
  void beginMoving();
  bool mayMove() const { return axes_.isSimulated() || memory_.mayMove(); }
  /// The wait for mayMove() is over: motors have power, or a stop came before.
  void endWait() { state_ = State::kInMotion; }

  /// Looks at the axes; to be called often. True while a record is due: then call keep().
  bool isDue(uint32_t now_ms);
  /// Stores a position with the counts of the axes.
  void keep(const settings::Position& position);

  /// Whether nothing is left to store.
  bool isSettled() const { return state_ == State::kKept || lost_ != 0; }

 private:
  enum class State : uint8_t {
    kAboutToMove,  ///< motors are about to get power
    kInMotion,     ///< motors had power when last looked at
    kSettling,     ///< no motor has power, but a motor may still run on
    kKept,         ///< the record is valid
  };
  enum : uint8_t { kLostChains = 1, kLostZ = 2, kUnset = 4 };

  void leaveRecord(State next);
  void takeCounts();
  int32_t farthestFromCounts() const;

  settings::Memory& memory_;
  const Axes& axes_;
  int32_t counts_[kAxisCount] = {0, 0, 0};  ///< of the record, or at the last look
  uint16_t looked_ms_ = 0, still_since_ms_ = 0;
  State state_ = State::kSettling;
  uint8_t lost_ = kUnset;
};

}  // namespace machine
