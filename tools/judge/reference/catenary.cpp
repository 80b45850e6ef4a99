// The elastic catenary in closed form.
#include "reference/catenary.h"

#include <cmath>

namespace reference {

double atanhExcess(double z_squared) {
  if (z_squared > 0.1) {
    const double z = std::sqrt(z_squared);
    return (std::atanh(z) / z - 1) / z_squared;
  }
  double sum = 0, power = 1;
  for (int k = 3; power > 1e-18 && k < 60; k += 2) {
    sum += power / k;
    power *= z_squared;
  }
  return sum;
}

Eigen::Vector3d spanOf(const Eigen::Vector3d& start, const Eigen::Vector3d& end, double length,
                       double compliance) {
  const Eigen::Vector3d mean = (start + end) / 2, change = end - start;
  const double sum = start.norm() + end.norm();
  const double z_squared = change.squaredNorm() / (sum * sum);
  const double excess = atanhExcess(z_squared);
  const double along_mean = 2 / sum * (1 + z_squared * excess) + compliance;
  const double along_change = -mean.dot(change) * 2 / (sum * sum * sum) * excess;
  return length * (along_mean * mean + along_change * change);
}

}  // namespace reference
