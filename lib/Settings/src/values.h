// The value of every setting, in RAM: checked when set, read by row.
#pragma once

#include "table.h"

namespace settings {

/// Why a value is not taken. The first four reasons are words of their own, in the order of Word.
enum class Refusal : uint8_t {
  kNone,        ///< it was taken
  kUnknown,     ///< no setting has that number
  kHidden,      ///< only the machine's commands set it
  kNoNumber,    ///< NaN or infinite
  kZero,        ///< zero, which this setting cannot be
  kOutOfRange,  ///< beyond the limits
  kBetween,     ///< not one of the steps
};

/// Whether a row may hold the value.
Refusal judge(const Entry& entry, float value);

/// A float for each row of a table, in memory of the caller.
class Values {
 public:
  /// `room` has one float for each row; filled with the defaults.
  Values(const Table& table, float* room);

  const Table& table() const { return table_; }
  uint8_t count() const { return count_; }

  /// The value in a row; the table's enum names the rows.
  float at(uint8_t index) const { return value_[index]; }

  /// The values of the rows from `index` on, in an array.
  const float* from(uint8_t index) const { return value_ + index; }

  /// Sets a listed setting by its $-number, or changes nothing and says why.
  Refusal set(uint8_t number, float value);

  /// Sets a row, listed or hidden: for the machine's commands and for loading.
  Refusal setRow(uint8_t index, float value);

  /// Sets every setting to its default; kKept settings only if `also_kept`.
  void reset(bool also_kept);

 private:
  const Table& table_;
  float* value_;
  uint8_t count_;
};

}  // namespace settings
