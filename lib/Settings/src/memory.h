// Everything that survives a power cut: what is found at the start, and who writes next.
#pragma once

#include "copies.h"
#include "event_log.h"
#include "position.h"
#include "published.h"

namespace settings {

/// Where the settings in force come from.
enum class Source : uint8_t {
  kOwn,           ///< our own copies
  kOwnInPart,     ///< the same, but a value beyond today's limits became its default
  kImported,      ///< the published firmware's, taken over whole
  kDefaults,      ///< nothing readable was there
  kOtherVersion,  ///< defaults (or our own): other firmware left data that is not read
  kBadValue,      ///< defaults (or our own): a published setting cannot be right
};

/// What the machine learns at power-on.
struct Started {
  Source source;
  uint8_t version;  ///< of the foreign data, with kOtherVersion; 0: before 1.00
  uint8_t number;   ///< the bad setting, with kBadValue
  Known known;
  Position position;  ///< meaningful unless known is kNothing
};

/// What $RST erases.
enum class Reset : uint8_t {
  kSettings,             ///< $RST=$
  kSettingsAndPosition,  ///< $RST=#
  kEverything,           ///< $RST=*
};

/// The EEPROM as a whole: settings, position, and the published firmware's remains.
/// What went wrong with the board is counted beside them.
///
/// Nothing blocks: step() writes at most one byte, and values are in force at once.
class Memory {
 public:
  enum : uint16_t { kFirstCopy = 544, kApart = 800, kFirstSlot = 2144 };
  /// Behind each copy, in the same 800 bytes, is a record of the log.
  enum : uint16_t { kCopyRoom = kApart - 16, kFirstLog = kFirstCopy + kCopyRoom };
  enum : uint8_t { kSlots = 65 };

  Memory(Bytes& bytes, Values& values);

  /// Reads everything. The only call that takes long: 70 ms.
  Started start();

  /// Does a little of what is to be done; writes at most one byte. To be called often.
  void step();

  /// Sets a listed setting by number; what is not refused is in force, and stored if
  /// it is another value.
  Refusal set(uint8_t number, float value);

  /// The same for a row, hidden or not.
  Refusal setRow(uint8_t index, float value);

  void reset(Reset what);

  /// The machine stands here; `position.scale` is filled in. Also after settings have changed.
  void keepPosition(Position position);

  /// Fingerprint of the settings that turn counts into lengths, for compare().
  uint16_t scale() const;

  /// The machine is about to move: call before each motion after rest, then wait for mayMove().
  void beginMoving();

  /// The counts were proved wrong: what is kept of the position holds no more, also after a power
  /// cut, until keepPosition().
  void doubtPosition() { slots_.doubt(); }

  /// Something has gone wrong with the board; kept whatever is reset.
  void note(Event event) { log_.note(event); }
  const EventLog& log() const { return log_; }

  /// True once a power cut would be noticed. Until then no motor may turn.
  bool mayMove() const;

  /// True once the settings in force are stored.
  bool settingsStored() const { return copies_.isStored(); }

  /// True if a copy of the settings does not keep what is written: the EEPROM wears out.
  bool isWorn() const { return copies_.isWorn(); }

  /// True when nothing is left to write.
  bool isIdle() const {
    return !retiring_ && !copies_.isBusy() && !slots_.isBusy() && !log_.isBusy();
  }

 private:
  void takeOver(const Recognised& found, Started& started);
  void storeSettings();
  void storeIfChanged(uint8_t index, float before);

  Bytes& bytes_;
  Values& values_;
  Copies copies_;
  PositionSlots slots_;
  EventLog log_;
  bool remains_;   ///< data of other firmware may still look valid
  bool retiring_;  ///< and is to be overwritten
};

}  // namespace settings
