// Finds a setting's row.
#include "table.h"

namespace settings {

uint8_t indexOf(const Table& table, uint8_t number) {
  const uint8_t count = table.count();
  for (uint8_t i = 0; i < count; ++i)
    if (table.at(i).number == number) return i;
  return kNoIndex;
}

}  // namespace settings
