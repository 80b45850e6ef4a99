// Writes and reads the two copies of all settings.
//
// A copy: 'P', 'm', layout, number of settings, sequence (2 bytes, low first); for each setting its
// $-number and its float (4 bytes, low first); CRC-32 of all that (4 bytes, low first).
#include "copies.h"

namespace settings {

namespace {

const uint8_t kMark[2] = {'P', 'm'};
const uint8_t kLayout = 1;

}  // namespace

Copies::Copies(Bytes& bytes, uint16_t first_address, uint16_t apart)
    : bytes_(bytes), first_(first_address), apart_(apart) {}

bool Copies::isValid(uint8_t copy) const {
  const uint16_t start = addressOf(copy);
  if (bytes_.read(start) != kMark[0] || bytes_.read(uint16_t(start + 1)) != kMark[1]) return false;
  if (bytes_.read(uint16_t(start + 2)) != kLayout) return false;
  const uint16_t size = bytesFor(bytes_.read(uint16_t(start + 3)));
  if (size > apart_) return false;
  Checksum sum;
  for (uint16_t i = 0; i < size - kSum; ++i) sum.add(bytes_.read(uint16_t(start + i)));
  return sum.value() == numberAt(bytes_, uint16_t(start + size - kSum), 4);
}

uint16_t Copies::sequenceOf(uint8_t copy) const {
  return uint16_t(numberAt(bytes_, uint16_t(addressOf(copy) + 4), 2));
}

Loaded Copies::read(uint8_t copy, Values& values) const {
  const uint16_t start = addressOf(copy);
  const uint8_t stored = bytes_.read(uint16_t(start + 3));
  Loaded loaded = Loaded::kAll;
  uint8_t index = 0;
  for (uint8_t i = 0; i < stored; ++i) {
    const uint16_t pair = uint16_t(start + kHead + kPair * i);
    const uint8_t number = bytes_.read(pair);
    // Numbers rise here as in the table, so a single pass through both is enough.
    while (index < values.count() && values.table().at(index).number < number) ++index;
    if (index == values.count()) break;
    if (values.table().at(index).number != number) continue;
    if (values.setRow(index, floatOf(numberAt(bytes_, uint16_t(pair + 1), 4))) != Refusal::kNone)
      loaded = Loaded::kSome;
  }
  return loaded;
}

Loaded Copies::load(Values& values) {
  const bool valid[2] = {isValid(0), isValid(1)};
  if (!valid[0] && !valid[1]) return Loaded::kNothing;
  const int16_t ahead = int16_t(sequenceOf(1) - sequenceOf(0));
  const uint8_t newest = valid[1] && (!valid[0] || ahead > 0);
  const bool alike = valid[0] && valid[1] && ahead == 0;
  sequence_ = sequenceOf(newest);
  target_ = uint8_t(1 - newest);
  to_write_ = alike ? 0 : 1;
  stored_ = true;
  passes_ = 0;
  beginPass();
  return read(newest, values);
}

void Copies::save() {
  // A copy with this sequence number may be whole already. The next copy needs another number.
  if (to_write_ < 2) ++sequence_;
  to_write_ = 2;
  stored_ = false;
  passes_ = 0;
  beginPass();
}

void Copies::beginPass() {
  done_ = 0;
  sum_ = Checksum();
  changed_ = false;
}

void Copies::endPass() {
  ++passes_;
  if (!changed_ || passes_ == kMostPasses) {
    if (changed_) worn_ = true;
    if (!changed_) stored_ = true;
    --to_write_;
    target_ ^= 1;
    passes_ = 0;
  }
  beginPass();
}

uint8_t Copies::byteAt(const Values& values, uint16_t place) const {
  if (place < 2) return kMark[place];
  if (place == 2) return kLayout;
  if (place == 3) return values.count();
  if (place < kHead) return uint8_t(sequence_ >> (8 * (place - 4)));
  const uint16_t sum_at = uint16_t(bytesFor(values.count()) - kSum);
  if (place >= sum_at) return uint8_t(sum_.value() >> (8 * (place - sum_at)));
  const uint8_t index = uint8_t((place - kHead) / kPair);
  const uint8_t part = uint8_t((place - kHead) % kPair);
  if (part == 0) return values.table().at(index).number;
  return uint8_t(bitsOf(values.at(index)) >> (8 * (part - 1)));
}

void Copies::step(const Values& values) {
  if (!isBusy()) return;
  const uint16_t size = bytesFor(values.count());
  for (uint8_t i = 0; i < kBytesLookedAt && done_ < size; ++i) {
    const uint8_t byte = byteAt(values, done_);
    const uint16_t address = uint16_t(addressOf(target_) + done_);
    if (done_ < size - kSum) sum_.add(byte);
    ++done_;
    if (bytes_.read(address) == byte) continue;
    bytes_.write(address, byte);
    changed_ = true;
    return;
  }
  if (done_ == size) endPass();
}

}  // namespace settings
