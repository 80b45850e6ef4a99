// The two records of the log, each with a CRC-32.
#include "event_log.h"

#include "checksum.h"

namespace settings {

namespace {

const uint8_t kEventIdentity[3] = {'P', 'e', 1};

}  // namespace

uint32_t EventLog::sumOf(const Record& record) {
  Checksum sum;
  for (uint8_t each : kEventIdentity) sum.add(each);
  const uint8_t* const at = reinterpret_cast<const uint8_t*>(&record);
  for (uint8_t i = sizeof record.sum; i < kBytes; ++i) sum.add(at[i]);
  return sum.value();
}

void EventLog::load() {
  for (uint8_t which = 0; which < 2; ++which) {
    Record record = {};
    uint8_t* const at = reinterpret_cast<uint8_t*>(&record);
    for (uint8_t i = 0; i < kBytes; ++i) at[i] = bytes_.read(uint16_t(addressOf(which) + i));
    if (record.sum != sumOf(record) || record.total <= record_.total) continue;
    record_ = record;
    newest_ = which;
  }
}

void EventLog::note(Event event) {
  uint16_t& count = record_.count[uint8_t(event)];
  if (count >= kMost) return;
  ++count;
  ++record_.total;
  record_.last = uint8_t(event);
  record_.sum = sumOf(record_);
  done_ = 0;
  was_tried_ = false;
  is_writing_ = true;
}

void EventLog::step() {
  const uint8_t target = newest_ ^ 1;
  const uint8_t* const record = reinterpret_cast<const uint8_t*>(&record_);
  for (; done_ < kBytes; ++done_, was_tried_ = false) {
    const uint16_t address = uint16_t(addressOf(target) + done_);
    if (bytes_.read(address) == record[done_]) continue;
    // A worn cell: the other record stays valid.
    if (was_tried_) break;
    was_tried_ = true;
    return bytes_.write(address, record[done_]);
  }
  if (done_ == kBytes) newest_ = target;
  is_writing_ = false;
}

}  // namespace settings
