// The published firmware's EEPROM, read by its structure: little-endian, no padding, in the order
// of the settings' numbers.
#include "published.h"

namespace settings {

namespace {

const uint16_t kVersionAt = 300, kMarkerAt = 301, kPublishedCountsAt = 310, kCountsMarkerAt = 322;
const uint16_t kBlockAt = 340, kEarlierEndAt = 486, kEndAt = 494;
const uint16_t kOldMarkersAt[] = {5, 105, 205};
const uint8_t kMarker = 56, kVersion = 5;
const uint8_t kLastNumber = 44, kUnused = 14;

bool isMarked(const Bytes& bytes, uint16_t address) { return bytes.read(address) == kMarker; }

/// Bytes that a setting takes there.
uint8_t sizeOf(uint8_t number) {
  switch (number) {
    case kUnused:
      return 0;
    case 7:
    case 16:
    case 38:
    case 39:
      return 1;
    case 9:
    case 10:
    case 11:
    case 15:
    case 17:
      return 2;
    default:
      return 4;
  }
}

/// The value that the published firmware used in place of a stored value it did not expect.
float asItMeant(const Entry& entry, float value) {
  switch (entry.number) {
    case 7:   // triangular, unless the value is 1
    case 38:  // off the bottom, unless the value is 1
      return value == 1 ? 1.0f : 2.0f;
    case 16:
      return value != 0 ? 1.0f : 0.0f;
    case 17:  // other numbers switched nothing
      return value > 3 ? 0.0f : value;
    case 43:
    case 44:  // a NaN was no limit
      return value == value ? value : entry.usual;
    default:
      return value;
  }
}

}  // namespace

Recognised recognise(const Bytes& bytes) {
  Recognised found = {Foreign::kNone, 0, false, false};
  if (isMarked(bytes, kMarkerAt)) {
    found.version = bytes.read(kVersionAt);
    found.has_z_limits = isMarked(bytes, kEndAt);
    if (found.version != kVersion) {
      found.foreign = Foreign::kOther;
      return found;
    }
    const bool whole = found.has_z_limits || isMarked(bytes, kEarlierEndAt);
    found.has_position = isMarked(bytes, kCountsMarkerAt);
    if (whole || found.has_position)
      found.foreign = whole ? Foreign::kVersion5 : Foreign::kPositionOnly;
    return found;
  }
  bool old = true;
  for (uint16_t address : kOldMarkersAt) old &= isMarked(bytes, address);
  if (old) found.foreign = Foreign::kBeforeOne;
  return found;
}

float publishedValue(const Bytes& bytes, uint8_t number) {
  uint16_t address = kBlockAt;
  for (uint8_t before = 0; before < number; ++before) address = uint16_t(address + sizeOf(before));
  const uint8_t size = sizeOf(number);
  const uint32_t bits = numberAt(bytes, address, size);
  return size < 4 ? float(bits) : floatOf(bits);
}

uint8_t importSettings(const Bytes& bytes, const Recognised& found, Values& values) {
  const uint8_t last = found.has_z_limits ? kLastNumber : uint8_t(kLastNumber - 2);
  // The first pass checks all values, the second takes them.
  for (uint8_t pass = 0; pass < 2; ++pass)
    for (uint8_t i = 0; i < values.count(); ++i) {
      const Entry entry = values.table().at(i);
      if (entry.number > last) break;
      const float value = asItMeant(entry, publishedValue(bytes, entry.number));
      if (pass == 0 && judge(entry, value) != Refusal::kNone) return entry.number;
      if (pass == 1) values.setRow(i, value);
    }
  return kNoIndex;
}

Position importPosition(const Bytes& bytes) {
  Position position = {};
  position.left = int32_t(numberAt(bytes, kPublishedCountsAt, 4));
  position.right = int32_t(numberAt(bytes, kPublishedCountsAt + 4, 4));
  position.z = int32_t(numberAt(bytes, kPublishedCountsAt + 8, 4));
  return position;
}

uint16_t nextToRetire(const Bytes& bytes) {
  // The marker first: without it neither firmware takes anything else as valid.
  static const uint16_t kMarkers[] = {kMarkerAt,      5, 105, 205, kEarlierEndAt, kEndAt,
                                      kCountsMarkerAt};
  for (uint16_t address : kMarkers)
    if (isMarked(bytes, address)) return address;
  return bytes.read(kVersionAt) == kErased ? kNothingLeft : kVersionAt;
}

}  // namespace settings
