// What the machine knows of where it is, and the only hand that writes it down.
#pragma once

#include <Settings.h>

#include "axes.h"

namespace machine {

/// Keeper of the position's record in the EEPROM.
///
/// The law: a record at rest is valid only while all motors are without power, stand still, and
/// their encoders still count what the record says. Whatever changes a length, a motor or a
/// declaration, makes the record a record of motion first; a new one is due once everything has
/// stood still for a moment. What is doubtful is never kept. Imagined motion (B99 ON) leaves the
/// record alone.
class PositionKeeper {
 public:
  PositionKeeper(settings::Memory& memory, const Axes& axes) : memory_(memory), axes_(axes) {}

  /// After the start, when the axes have the counts of the record.
  void begin(settings::Known known);

  /// Whether the lengths of both chains can be trusted.
  bool trustsChains() const { return (lost_ & (kLostChains | kUnset)) == 0; }
  /// Whether z can be trusted, too.
  bool trustsAll() const { return lost_ == 0; }
  /// Whether the length of an axis can be trusted.
  bool trusts(Axis axis) const {
    return axis == kZAxis ? (lost_ & (kLostZ | kUnset)) == 0 : trustsChains();
  }
  /// Whether something was known that is not any more.
  bool hasLost() const { return (lost_ & (kLostChains | kLostZ)) != 0; }

  /// The counts of an axis were proved wrong: nothing is kept until it is declared.
  void doubt(Axis axis);
  /// The counts of the chains were; also what a record says of them.
  void doubtChains() { doubt(kLeftAxis); }
  /// Nothing was ever known, or it was erased: there is no record.
  void startAfresh() { lost_ = kUnset; }

  /// Somebody declared the lengths of the chains: all of it is trusted again.
  void declareChains();
  /// Somebody declared z.
  void declareZ();
  /// Lengths stay as they are, but counts mean others, or the chains another place.
  void reconsider();

  /// Call before motors get power, then wait for mayMove().
  void beginMoving();
  bool mayMove() const { return axes_.isSimulated() || memory_.mayMove(); }
  /// The wait for mayMove() is over: motors have power, or a stop came before.
  void endWait() { state_ = State::kInMotion; }

  /// Looks at the axes; to be called often. True while a record is due: then keep() it.
  bool isDue(uint32_t now_ms);
  /// Keeps a position whose counts are those of the axes.
  void keep(const settings::Position& position);

  /// Nothing is left to be kept.
  bool isSettled() const { return state_ == State::kKept || lost_ != 0; }

 private:
  enum class State : uint8_t {
    kAboutToMove,  ///< motors are about to get power
    kInMotion,     ///< motors had power when last looked at
    kSettling,     ///< no motor has power, but one may still run on
    kKept,         ///< the record is valid
  };
  enum : uint8_t { kLostChains = 1, kLostZ = 2, kUnset = 4 };

  void leaveRecord(State next);
  void takeCounts();
  int32_t farthestFromCounts() const;

  settings::Memory& memory_;
  const Axes& axes_;
  int32_t counts_[kAxisCount] = {0, 0, 0};  ///< of the record, or when last looked at
  uint16_t looked_ms_ = 0, still_since_ms_ = 0;
  State state_ = State::kSettling;
  uint8_t lost_ = kUnset;
};

}  // namespace machine
