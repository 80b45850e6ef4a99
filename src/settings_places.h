// The rows of places that G-code keeps: where G54 to G59 begin, and where G28 and G30 go.
#pragma once

#include <Settings.h>

const uint8_t kFirstPlaceNumber = 230;  ///< the $-number of the first place's x
const uint8_t kKeptSystems = 6;         ///< G54 to G59
const uint8_t kPlaceAxes = 3;           ///< x, y, z

/// How many rows there are: six systems, and two places to go to.
const uint8_t kPlaceCount = (kKeptSystems + 2) * kPlaceAxes;

const float kNoPlace = 20000;  ///< [mm] stands for a place that was never set

/// The row of a place's coordinate, counted over all places.
inline settings::Entry placeRow(uint8_t index) {
  const bool is_goal = index >= kKeptSystems * kPlaceAxes;
  return {uint8_t(kFirstPlaceNumber + index),
          settings::Kind::kReal,
          settings::Access::kHidden,
          settings::kAnyValue,
          settings::kNothing,
          is_goal ? kNoPlace : 0.0f,
          -kNoPlace,
          kNoPlace};
}
