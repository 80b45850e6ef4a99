// A heavy elastic chain between two points, exactly; a weightless chain needs no special case.
#pragma once

#include <Eigen/Core>

namespace reference {

/// (atanh(z) / z - 1) / z^2 as a function of z^2, smooth through zero, where it is 1/3.
double atanhExcess(double z_squared);

/// Vector [mm] from the start to the end of a chain that is `length` [mm] long without load.
///
/// The tension is a vector along the chain. Only weight acts in between, so the tension changes
/// evenly from `start` to `end` [N]. The chain follows the unit vector of that tension, times
/// 1 + compliance * tension [1/N]. With mean m = (start + end) / 2, change d = end - start and
/// s = |start| + |end|, the integral of the unit vector is
///   length * (m * 2/s * (1 + z^2 g) - d * (m.d) * 2/s^3 * g),  z = |d|/s,  g = atanhExcess(z^2),
/// which is Irvine's elastic catenary (Cable Structures, 1981, section 1.4). The difference of two
/// asinh is written as twice an atanh, so that no digits cancel when the chain has no weight.
Eigen::Vector3d spanOf(const Eigen::Vector3d& start, const Eigen::Vector3d& end, double length,
                       double compliance);

}  // namespace reference
