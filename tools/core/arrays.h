// Shared by the bindings: Python's arrays, and the machine that an array of values describes.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <algorithm>
#include <vector>

#include "Kinematics.h"
#include "frame_info.h"

namespace core {

namespace nb = nanobind;
using namespace kinematics;

enum { kSettingCount = kFrameFieldCount + kEffectParamCount };

using Values = nb::ndarray<const double, nb::shape<-1>, nb::c_contig, nb::device::cpu>;
using Pairs = nb::ndarray<const double, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;

/// A new numpy array of zeros that owns its memory.
template <class Number>
nb::ndarray<nb::numpy, Number> newArray(std::vector<size_t> shape, Number** data) {
  size_t size = 1;
  for (size_t n : shape) size *= n;
  *data = new Number[size]();
  nb::capsule owner(*data, [](void* p) noexcept { delete[] static_cast<Number*>(p); });
  return nb::ndarray<nb::numpy, Number>(*data, shape.size(), shape.data(), owner);
}

/// Frame and effects of a values array.
template <class Real>
struct Described {
  Frame<Real> frame;
  EffectParams<Real> effects;
};

template <class Real>
Described<Real> describedBy(const std::vector<Real>& values, bool over_top) {
  Described<Real> described;
  for (int i = 0; i < kFrameFieldCount; ++i)
    described.frame.*frameFields<Real>()[i].member = values[i];
  described.frame.feed = over_top ? Feed::kOverTop : Feed::kOffBottom;
  std::copy(values.begin() + kFrameFieldCount, values.end(), described.effects.value);
  return described;
}

template <class Real>
std::vector<Real> numbers(const Values& values) {
  if (values.shape(0) != kSettingCount)
    throw nb::value_error("values must hold one number for each entry of settings()");
  std::vector<Real> result;
  for (size_t i = 0; i < kSettingCount; ++i) result.push_back(static_cast<Real>(values(i)));
  return result;
}

}  // namespace core
