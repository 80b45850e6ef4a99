// An EEPROM as the published firmware leaves it, written by its documented map. It shares nothing
// with the code that reads it.
#pragma once

#include <cstring>
#include <utility>

#include "eeprom.h"

using settings_host::Eeprom;

/// A setting in the block: number, offset from address 340, bytes, and a value that is not the
/// default.
struct InBlock {
  uint8_t number, offset, bytes;
  float value;
};

// Offsets as the protocol's map lists them.
const InBlock kBlock[] = {
    {0, 0, 4, 2440.5f},    {1, 4, 4, 1220.5f},   {2, 8, 4, 3602.6f},  {3, 12, 4, 468.4f},
    {4, 16, 4, 311},       {5, 20, 4, 138.5f},   {6, 24, 4, 78.5f},   {7, 28, 1, 2},
    {8, 29, 4, 139.1f},    {9, 33, 2, 3000},     {10, 35, 2, 4100},   {11, 37, 2, 1650},
    {12, 39, 4, 8148},     {13, 43, 4, 63.6f},   {15, 47, 2, 800},    {16, 49, 1, 0},
    {17, 50, 2, 2},        {18, 52, 4, 11.5f},   {19, 56, 4, -3.2f},  {20, 60, 4, -7000},
    {21, 64, 4, 1200},     {22, 68, 4, 1.5f},    {23, 72, 4, 33},     {24, 76, 4, 0.9f},
    {25, 80, 4, 4},        {26, 84, 4, 0.25f},   {27, 88, 4, 0.3f},   {28, 92, 4, 0.8f},
    {29, 96, 4, 1301},     {30, 100, 4, 2.5f},   {31, 104, 4, 35},    {32, 108, 4, 0.7f},
    {33, 112, 4, 6},       {34, 116, 4, 0.5f},   {35, 120, 4, 0.26f}, {36, 124, 4, 0.6f},
    {37, 128, 4, 31.865f}, {38, 132, 1, 2},      {39, 133, 1, 2},     {40, 134, 4, 0.25f},
    {41, 138, 4, -0.125f}, {42, 142, 4, 2000.f},
};
const InBlock kZLimits[] = {{43, 146, 4, 10.5f}, {44, 150, 4, -20.25f}};

inline void storeLow(Eeprom& eeprom, int address, uint32_t number, int bytes) {
  for (int i = 0; i < bytes; ++i) eeprom[uint16_t(address + i)] = uint8_t(number >> (8 * i));
}

inline void storeSetting(Eeprom& eeprom, const InBlock& at, float value) {
  uint32_t bits;
  std::memcpy(&bits, &value, 4);
  storeLow(eeprom, 340 + at.offset, at.bytes == 4 ? bits : uint32_t(value), at.bytes);
}

/// The counts that the image holds.
struct Counts {
  int32_t left = 217533, right = 217534, z = -1234;
};

/// An image of version 5, with the layout with Z limits or the layout before it.
inline Eeprom publishedImage(bool z_limits, bool position = true) {
  Eeprom eeprom;
  eeprom[300] = 5;
  eeprom[301] = 56;
  const Counts counts;
  storeLow(eeprom, 310, uint32_t(counts.left), 4);
  storeLow(eeprom, 314, uint32_t(counts.right), 4);
  storeLow(eeprom, 318, uint32_t(counts.z), 4);
  if (position) eeprom[322] = 56;
  for (const InBlock& each : kBlock) storeSetting(eeprom, each, each.value);
  if (z_limits)
    for (const InBlock& each : kZLimits) storeSetting(eeprom, each, each.value);
  eeprom[z_limits ? 494 : 486] = 56;
  return eeprom;
}

/// Whether the published firmware would take the settings, or the counts, as valid.
inline bool publishedFindsSettings(Eeprom& eeprom) {
  return eeprom[300] == 5 && eeprom[301] == 56 && (eeprom[494] == 56 || eeprom[486] == 56);
}
inline bool publishedFindsPosition(Eeprom& eeprom) { return eeprom[322] == 56; }
