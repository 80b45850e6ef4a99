// Reading at the start, and the next copy to write.
#include "memory.h"

#include "checksum.h"

namespace settings {

namespace {

/// Checksum of the settings that turn encoder counts into lengths.
uint16_t scaleOf(const Values& values) {
  Checksum sum;
  for (uint8_t row = 0; row < values.count(); ++row) {
    if ((values.table().at(row).touches & kScale) == 0) continue;
    const uint32_t bits = bitsOf(values.at(row));
    for (uint8_t i = 0; i < 4; ++i) sum.add(uint8_t(bits >> (8 * i)));
  }
  return uint16_t(sum.value());
}

Source sourceOf(Loaded loaded) {
  if (loaded == Loaded::kNothing) return Source::kDefaults;
  return loaded == Loaded::kAll ? Source::kStored : Source::kStoredInPart;
}

}  // namespace

Memory::Memory(Bytes& bytes, Values& values)
    : bytes_(bytes),
      values_(values),
      copies_(bytes, kFirstCopy, kApart),
      slots_(bytes, kFirstSlot, kSlots),
      log_(bytes, kFirstLog, kApart) {}

uint16_t Memory::scale() const { return scaleOf(values_); }

Started Memory::start() {
  Started started = {};
  started.number = kNoIndex;
  const Loaded loaded = copies_.load(values_);
  started.source = sourceOf(loaded);
  started.known = slots_.load(started.position);
  log_.load();
  remains_ = nextToRetire(bytes_) != kNothingLeft;
  retiring_ = remains_ && loaded != Loaded::kNothing;
  if (loaded == Loaded::kSome) copies_.save();
  takeOver(recognise(bytes_), started);
  return started;
}

void Memory::takeOver(const Recognised& found, Started& started) {
  // Its data is retired before we ever move, so if it is valid it is newer than ours.
  switch (found.foreign) {
    case Foreign::kNone:
      return;
    case Foreign::kVersion5:
      started.number = importSettings(bytes_, found, values_);
      started.source = started.number == kNoIndex ? Source::kImported : Source::kBadValue;
      break;
    case Foreign::kPositionOnly:
      break;
    case Foreign::kOther:
    case Foreign::kBeforeOne:
      started.source = Source::kOtherVersion;
      started.version = found.version;
  }
  if (started.source == Source::kImported) storeSettings();
  if (found.has_position && started.source != Source::kBadValue) {
    started.position = importPosition(bytes_);
    started.position.scale = scale();
    started.known = Known::kAtRest;
    slots_.keep(started.position);
  } else if (started.known == Known::kAtRest) {
    // The published firmware may have moved the sled since.
    started.known = Known::kMoving;
    slots_.beginMoving();
  }
}

void Memory::storeSettings() {
  copies_.save();
  retiring_ = remains_;
}

void Memory::step() {
  if (!bytes_.ready()) return;
  // A motion waits until the position is marked; nothing waits for the rest.
  if (slots_.isBusy()) return slots_.step();
  if (copies_.isBusy()) return copies_.step(values_);
  if (log_.isBusy()) return log_.step();
  if (!retiring_) return;
  const uint16_t address = nextToRetire(bytes_);
  remains_ = retiring_ = address != kNothingLeft;
  if (retiring_) bytes_.write(address, kErased);
}

Refusal Memory::set(uint8_t number, float value) {
  const uint8_t index = indexOf(values_.table(), number);
  if (index == kNoIndex) return Refusal::kUnknown;
  const float before = values_.at(index);
  const Refusal why = values_.set(number, value);
  if (why == Refusal::kNone) storeIfChanged(index, before);
  return why;
}

Refusal Memory::setRow(uint8_t index, float value) {
  if (index >= values_.count()) return Refusal::kUnknown;
  const float before = values_.at(index);
  const Refusal why = values_.setRow(index, value);
  if (why == Refusal::kNone) storeIfChanged(index, before);
  return why;
}

void Memory::storeIfChanged(uint8_t index, float before) {
  // On a new board the first `set` stores all settings, even if it changes nothing.
  if (values_.at(index) != before || !copies_.isStored()) storeSettings();
}

void Memory::reset(Reset what) {
  values_.reset(what == Reset::kEverything);
  if (what != Reset::kSettings) slots_.forget();
  storeSettings();
}

void Memory::keepPosition(Position position) {
  position.scale = scale();
  slots_.keep(position);
}

void Memory::beginMoving() {
  retiring_ = remains_;
  slots_.beginMoving();
}

bool Memory::mayMove() const { return slots_.mayMove() && !retiring_; }

}  // namespace settings
