// The ring of position records.
//
// A record: sequence (2 bytes), what is known (1), counts of left, right and z (4 each), x and y (a
// float each), scale (2), mark (1), CRC-32 of all but the mark (4); low bytes first.
#include "position.h"

#include <math.h>

#include "checksum.h"

namespace settings {

namespace {

enum : uint8_t { kKnownAt = 2, kCountsAt = 3, kPlaceAt = 15, kScaleAt = 23, kMarkAt = 25, kSumAt };
enum : uint8_t { kIsKnown = 1, kHasPlace = 2 };
const uint8_t kIdentity[3] = {'P', 'p', 1};

bool isDoubt(uint8_t mark) {
  return mark == uint8_t(Doubt::kCounts) ||
         (mark >= uint8_t(Doubt::kMoving) && mark <= uint8_t(Doubt::kStack));
}

uint32_t sumOf(const uint8_t* record) {
  Checksum sum;
  for (uint8_t each : kIdentity) sum.add(each);
  for (uint8_t i = 0; i < kMarkAt; ++i) sum.add(record[i]);
  return sum.value();
}

void store(uint8_t* at, uint32_t number, uint8_t bytes) {
  for (uint8_t i = 0; i < bytes; ++i) at[i] = uint8_t(number >> (8 * i));
}

uint32_t fetch(const uint8_t* at, uint8_t bytes) {
  uint32_t number = 0;
  for (uint8_t i = 0; i < bytes; ++i) number |= uint32_t(at[i]) << (8 * i);
  return number;
}

Position positionIn(const uint8_t* record) {
  Position position;
  position.left = int32_t(fetch(record + kCountsAt, 4));
  position.right = int32_t(fetch(record + kCountsAt + 4, 4));
  position.z = int32_t(fetch(record + kCountsAt + 8, 4));
  position.x = floatOf(fetch(record + kPlaceAt, 4));
  position.y = floatOf(fetch(record + kPlaceAt + 4, 4));
  position.scale = uint16_t(fetch(record + kScaleAt, 2));
  position.has_place = record[kKnownAt] & kHasPlace;
  return position;
}

}  // namespace

Agreement compare(const Position& kept, uint16_t scale, float x, float y) {
  if (kept.scale != scale) return Agreement::kScaleChanged;
  const float dx = x - kept.x, dy = y - kept.y;
  // Written so that a NaN differs.
  const bool same = !kept.has_place || sqrt(dx * dx + dy * dy) < kSamePlace;
  return same ? Agreement::kAgrees : Agreement::kPlaceDiffers;
}

PositionSlots::PositionSlots(Bytes& bytes, uint16_t first_address, uint8_t slots)
    : bytes_(bytes), first_(first_address), slots_(slots), newest_(uint8_t(slots - 1)) {}

bool PositionSlots::isValid(uint8_t slot) const {
  uint8_t record[kBytesPerSlot];
  for (uint8_t i = 0; i < kBytesPerSlot; ++i)
    record[i] = bytes_.read(uint16_t(addressOf(slot) + i));
  return sumOf(record) == fetch(record + kSumAt, 4);
}

Known PositionSlots::load(Position& position) {
  bool found = false;
  for (uint8_t slot = 0; slot < slots_; ++slot) {
    if (!isValid(slot)) continue;
    const uint16_t start = addressOf(slot);
    const uint16_t number = uint16_t(numberAt(bytes_, start, 2));
    if (found && int16_t(number - sequence_) < 0) continue;
    found = true;
    sequence_ = number;
    newest_ = slot;
  }
  exists_ = found;
  if (!found) return Known::kNothing;
  readNewest();
  const uint8_t mark = record_[kMarkAt];
  mark_ = mark == kRests || isDoubt(mark) ? mark : uint8_t(kMoved);
  position = positionIn(record_);
  if (!(record_[kKnownAt] & kIsKnown)) return Known::kNothing;
  if (mark_ == kRests) return Known::kAtRest;
  if (mark_ == kMoved) return Known::kMoving;
  wanted_ = mark_;
  return Known::kDoubted;
}

void PositionSlots::readNewest() {
  for (uint8_t i = 0; i < kBytesPerSlot; ++i)
    record_[i] = bytes_.read(uint16_t(addressOf(newest_) + i));
  holds_newest_ = true;
}

void PositionSlots::begin(const uint8_t* record, uint8_t mark) {
  memmove(record_, record, kMarkAt);
  store(record_, uint16_t(sequence_ + 1), 2);
  record_[kMarkAt] = mark;
  store(record_ + kSumAt, sumOf(record_), 4);
  if (!writing_) maybe_whole_ = false;
  writing_ = true;
  tried_ = false;
  target_ = after(newest_);
  failed_ = 0;
  done_ = 0;
}

void PositionSlots::keep(const Position& position) {
  uint8_t fresh[kMarkAt] = {};
  fresh[kKnownAt] = uint8_t(kIsKnown | (position.has_place ? kHasPlace : 0));
  store(fresh + kCountsAt, uint32_t(position.left), 4);
  store(fresh + kCountsAt + 4, uint32_t(position.right), 4);
  store(fresh + kCountsAt + 8, uint32_t(position.z), 4);
  store(fresh + kPlaceAt, bitsOf(position.x), 4);
  store(fresh + kPlaceAt + 4, bitsOf(position.y), 4);
  store(fresh + kScaleAt, position.scale, 2);
  moving_ = false;
  wanted_ = kMoved;
  // A position that is already stored is not written again.
  const bool there = (writing_ || holds_newest_) && record_[kMarkAt] == kRests &&
                     !memcmp(record_ + kKnownAt, fresh + kKnownAt, kMarkAt - kKnownAt);
  if (!there) begin(fresh, kRests);
}

void PositionSlots::forget() {
  const uint8_t nothing[kMarkAt] = {};
  moving_ = false;
  wanted_ = kMoved;
  begin(nothing, kRests);
}

void PositionSlots::beginMoving() {
  moving_ = true;
  // A record without its checksum does not count; the record before it says enough. A record that
  // could be whole is finished first, so that there is no doubt which record is the newest.
  // A record that says that nothing is known is right in motion too.
  const bool says_nothing = !(record_[kKnownAt] & kIsKnown);
  if (!writing_ || maybe_whole_ || !exists_ || says_nothing) return;
  writing_ = false;
  holds_newest_ = false;
}

void PositionSlots::doubt(Doubt why) {
  if (wanted_ == kMoved) want(uint8_t(why));
  beginMoving();
}

void PositionSlots::want(uint8_t mark) {
  wanted_ = mark;
  tried_ = false;
  // Without a record there is nothing to mark.
  if (!exists_ && !writing_) mark_ = mark;
}

void PositionSlots::step() {
  if (writing_) {
    writeRecord();
  } else if (moving_ && mark_ != wanted_) {
    writeMark();
  }
}

void PositionSlots::writeRecord() {
  while (done_ < kBytesPerSlot) {
    const uint16_t address = uint16_t(addressOf(target_) + done_);
    const uint8_t byte = record_[done_];
    if (done_ >= kSumAt) maybe_whole_ = true;
    ++done_;
    if (bytes_.read(address) == byte) continue;
    bytes_.write(address, byte);
    return;
  }
  bool right = true;
  for (uint8_t i = 0; i < kBytesPerSlot; ++i)
    right &= bytes_.read(uint16_t(addressOf(target_) + i)) == record_[i];
  if (!right && ++failed_ < slots_) {
    // A worn cell: the next slot may do.
    target_ = after(target_);
    done_ = 0;
    return;
  }
  writing_ = false;
  holds_newest_ = true;
  exists_ = true;
  newest_ = target_;
  ++sequence_;
  mark_ = record_[kMarkAt];
}

void PositionSlots::writeMark() {
  const uint16_t address = uint16_t(addressOf(newest_) + kMarkAt);
  // Also keep() may come while the byte is on its way; it then writes a new record.
  holds_newest_ = false;
  if (bytes_.read(address) == wanted_) {
    mark_ = wanted_;
    tried_ = false;
  } else if (!tried_) {
    bytes_.write(address, wanted_);
    tried_ = true;
  } else {
    // A worn cell: write a new record in another slot, marked as moving from the start.
    readNewest();
    begin(record_, wanted_);
  }
}

}  // namespace settings
