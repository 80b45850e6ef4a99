// Everything that survives a power cut: reading it at the start, and writing it in turns.
#pragma once

#include "copies.h"
#include "event_log.h"
#include "position.h"
#include "published.h"

namespace settings {

/// Where the settings in force come from.
enum class Source : uint8_t {
  kStored,        ///< a copy of ours
  kStoredInPart,  ///< a copy of ours, but a value beyond today's limits became its default
  kImported,      ///< imported from the published firmware
  kDefaults,      ///< nothing readable is stored
  kOtherVersion,  ///< defaults (or a copy of ours): other firmware left data that is not read
  kBadValue,      ///< defaults (or a copy of ours): a published setting cannot be right
};

/// Findings of the machine at power-on.
struct Started {
  Source source;
  uint8_t version;  ///< of the other firmware's data, with kOtherVersion; 0: before 1.00
  uint8_t number;   ///< the bad setting, with kBadValue
  Known known;
  Position position;  ///< meaningful unless known is kNothing
};

/// Parts that $RST erases.
enum class Reset : uint8_t {
  kSettings,             ///< $RST=$
  kSettingsAndPosition,  ///< $RST=#
  kEverything,           ///< $RST=*
};

/// The whole EEPROM: settings, position, the log of what went wrong with the board, and data that
/// the published firmware left.
///
/// Nothing blocks: step() writes at most one byte, and values are in force at once.
class Memory {
 public:
  enum : uint16_t { kFirstCopy = 544, kApart = 800, kFirstSlot = 2144 };
  /// Each copy has 800 bytes; the record of the log at their end takes 16 of them.
  enum : uint16_t { kCopyRoom = kApart - 16, kFirstLog = kFirstCopy + kCopyRoom };
  enum : uint8_t { kSlots = 65 };

  Memory(Bytes& bytes, Values& values);

  /// Reads everything. This is the only slow call: 70 ms.
  Started start();

  /// Does a small part of the work; writes at most one byte. To be called often.
  void step();

  /// Sets a listed setting by number. A value that is not refused is in force at once, and is
  /// stored if it is new.
  Refusal set(uint8_t number, float value);

  /// Sets a row, listed or hidden.
  Refusal setRow(uint8_t index, float value);

  void reset(Reset what);

  /// Stores where the machine stands, and fills in `position.scale`. To be called at rest, and
  /// after settings have changed.
  void keepPosition(Position position);

  /// Fingerprint of the settings that turn counts into lengths, for compare().
  uint16_t scale() const;

  /// To be called before each motion from rest; then wait for mayMove().
  void beginMoving();

  /// To be called when the counts are proved wrong: until keepPosition() the stored position counts
  /// as doubted, even after a power cut.
  void doubtPosition(Doubt why) { slots_.doubt(why); }
  /// To be called when chains are declared again.
  void endDoubt() { slots_.endDoubt(); }
  Doubt doubted() const { return slots_.doubted(); }

  /// Counts an event in the log, which no reset erases.
  void note(Event event) { log_.note(event); }
  const EventLog& log() const { return log_; }

  /// True once a power cut in motion would be noticed. Until then no motor may turn.
  bool mayMove() const;

  /// True once the settings in force are stored.
  bool settingsStored() const { return copies_.isStored(); }

  /// True if a copy of the settings does not keep what is written: the EEPROM is worn out.
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
  bool remains_ = false;   ///< data of other firmware may still look valid
  bool retiring_ = false;  ///< such data is being overwritten
};

}  // namespace settings
