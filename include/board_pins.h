// Pin numbers of each motor shield, and nothing else. Sources: the shields' silkscreens, as the
// published firmware and its users list them. The numbers are Arduino's for the Mega 2560.
#pragma once

#include <stdint.h>

namespace board {

/// Six inputs with pull-up. A shield straps some of them to ground, and so says which shield it is.
enum : uint8_t { kFirstStrapPin = 22, kStrapCount = 6 };

enum class Driver : uint8_t { kL298, kTle5206, kTb6643, kTle9201 };

const uint8_t kNoPin = 255;

/// A motor: its encoder channels, and its driver's two direction inputs and enable. On the TLE9201
/// these three are direction, disable and PWM. On the TLE5206 enable is an error flag, an input.
struct MotorPins {
  uint8_t encoder_a, encoder_b;
  uint8_t first, second, enable;
};

/// A shield as sold.
struct Shield {
  uint8_t straps;   ///< 1 for each open strap, the lowest bit for kFirstStrapPin
  uint8_t version;  ///< N of "v1.N", as the boards are called
  Driver driver;
  MotorPins right, z, left;
  uint8_t spindle, laser, probe;
};

// clang-format off
const Shield kShields[] = {
    {61, 0, Driver::kL298, {18, 19, 9, 8, 6}, {2, 3, 11, 10, 7}, {21, 20, 12, 13, 5}, 17, 16, 14},
    {62, 1, Driver::kL298, {20, 21, 6, 4, 5}, {19, 18, 9, 7, 8}, {2, 3, 10, 11, 12}, 17, 16, 14},
    {63, 2, Driver::kL298, {20, 21, 4, 6, 5}, {19, 18, 7, 9, 8}, {2, 3, 11, 12, 10}, 17, 16, 14},
    {52, 3, Driver::kTle5206, {20, 21, 6, 4, 5}, {19, 18, 7, 9, 8}, {2, 3, 10, 11, 12}, 40, 41, 43},
    {4, 4, Driver::kTle5206, {20, 21, 6, 4, 5}, {19, 18, 7, 9, 8}, {2, 3, 10, 11, 12}, 40, 41, 43},
    {6, 5, Driver::kTb6643, {2, 3, 9, 10, kNoPin}, {18, 19, 7, 8, kNoPin}, {21, 20, 6, 5, kNoPin}, 48, 50, 49},
    {7, 6, Driver::kTle9201, {20, 21, 4, 5, 6}, {19, 18, 7, 8, 9}, {2, 3, 11, 12, 10}, 40, 41, 43},
    {8, 8, Driver::kTb6643, {20, 21, 6, 5, kNoPin}, {19, 18, 8, 7, kNoPin}, {2, 3, 10, 9, kNoPin}, 40, 41, 43},
};
// clang-format on
enum : uint8_t { kShieldCount = sizeof kShields / sizeof kShields[0] };

}  // namespace board
