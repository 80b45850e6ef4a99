// A chain of springs and beads in its lowest energy, worked out without forces or angles.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "machines.h"

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;
using reference::Hang;
using reference::Machine;

namespace {

/// The sled on two chains of `links` springs each. Unknowns: the inner beads of both chains, the
/// angles of both arms about the bit, the bit.
class Beads {
 public:
  Beads(const Machine& machine, const Hang& hang, int links)
      : machine_(machine), hang_(hang), links_(links), beads_(links - 1) {}

  /// [mm] where the bit comes to rest.
  Vector2d settle() const {
    VectorXd at = start();
    for (int i = 0; i < 100; ++i) {
      const VectorXd slope = slopeOf(at);
      const VectorXd step = curvatureOf(at).ldlt().solve(slope);
      double share = 1;
      while (share > 1e-3 && energyOf(at - share * step) > energyOf(at) + 1e-9) share /= 2;
      at -= share * step;
      if (step.lpNorm<Eigen::Infinity>() < 1e-10) return at.tail<2>();
    }
    ADD_FAILURE() << "did not settle";
    return at.tail<2>();
  }

 private:
  int size() const { return 4 * beads_ + 4; }

  const reference::ChainForm& formOf(int side) const {
    return side == 0 ? hang_.left : hang_.right;
  }

  Vector2d ringOf(const VectorXd& at, int side) const {
    const double angle = at[4 * beads_ + side];
    return at.tail<2>() + machine_.rotation_radius * Vector2d(std::cos(angle), std::sin(angle));
  }

  /// Bead 0 is on the sprocket, the last bead on the ring.
  Vector2d beadOf(const VectorXd& at, int side, int bead) const {
    if (bead == 0) return formOf(side).leaves.head<2>();
    if (bead == links_) return ringOf(at, side);
    return at.segment<2>(2 * (beads_ * side + bead - 1));
  }

  /// Straight stretched chains to a place near the judge's.
  VectorXd start() const {
    VectorXd at(size());
    at.tail<2>() = hang_.bit + Vector2d(3, -6);
    for (int side : {0, 1}) {
      const Vector2d away = formOf(side).leaves.head<2>() - at.tail<2>();
      at[4 * beads_ + side] = std::atan2(away.y(), away.x());
    }
    for (int side : {0, 1})
      for (int bead = 1; bead < links_; ++bead) {
        const Vector2d from = formOf(side).leaves.head<2>(), to = ringOf(at, side);
        at.segment<2>(2 * (beads_ * side + bead - 1)) = from + (to - from) * bead / links_;
      }
    return at;
  }

  double weightOf(int side) const {
    const reference::ChainSide& chain = side == 0 ? machine_.left : machine_.right;
    return chain.weight * formOf(side).free_length / links_;
  }

  double energyOf(const VectorXd& at) const {
    double energy = machine_.sled_weight * at[size() - 1];
    for (int side : {0, 1}) {
      const double natural = formOf(side).free_length / links_;
      const double compliance = side == 0 ? machine_.left.compliance : machine_.right.compliance;
      for (int link = 0; link < links_; ++link) {
        const Vector2d start = beadOf(at, side, link), end = beadOf(at, side, link + 1);
        const double stretch = (end - start).norm() - natural;
        energy += stretch * stretch / (2 * compliance * natural);
        energy += weightOf(side) * (start.y() + end.y()) / 2;  // half on each bead
      }
    }
    return energy;
  }

  /// Adds what a change of a single bead does to the energy.
  void addSlope(const VectorXd& at, int side, int bead, const Vector2d& force,
                VectorXd& slope) const {
    if (bead == 0) return;
    if (bead < links_) {
      slope.segment<2>(2 * (beads_ * side + bead - 1)) += force;
      return;
    }
    const double angle = at[4 * beads_ + side];
    slope.tail<2>() += force;
    slope[4 * beads_ + side] +=
        machine_.rotation_radius * (force.y() * std::cos(angle) - force.x() * std::sin(angle));
  }

  VectorXd slopeOf(const VectorXd& at) const {
    VectorXd slope = VectorXd::Zero(size());
    slope[size() - 1] = machine_.sled_weight;
    for (int side : {0, 1}) {
      const double natural = formOf(side).free_length / links_;
      const double compliance = side == 0 ? machine_.left.compliance : machine_.right.compliance;
      const Vector2d half(0, weightOf(side) / 2);
      for (int link = 0; link < links_; ++link) {
        const Vector2d along = beadOf(at, side, link + 1) - beadOf(at, side, link);
        const double tension = (along.norm() / natural - 1) / compliance;
        const Vector2d pull = tension * along.normalized();
        addSlope(at, side, link, half - pull, slope);
        addSlope(at, side, link + 1, half + pull, slope);
      }
    }
    return slope;
  }

  MatrixXd curvatureOf(const VectorXd& at) const {
    MatrixXd curvature(size(), size());
    for (int i = 0; i < size(); ++i) {
      const bool is_angle = i == 4 * beads_ || i == 4 * beads_ + 1;
      const double step = is_angle ? 1e-6 : 1e-4;
      VectorXd more = at, less = at;
      more[i] += step;
      less[i] -= step;
      curvature.col(i) = (slopeOf(more) - slopeOf(less)) / (2 * step);
    }
    return (curvature + curvature.transpose()) / 2;
  }

  Machine machine_;
  Hang hang_;
  int links_, beads_;
};

/// Errors of a chain of n links fall with 1/n^2: three chains cancel two terms of that series.
Vector2d settleFinest(const Machine& machine, const Hang& hang) {
  const Vector2d coarse = Beads(machine, hang, 8).settle();
  const Vector2d middle = Beads(machine, hang, 16).settle();
  const Vector2d fine = Beads(machine, hang, 32).settle();
  const Vector2d first = (4 * middle - coarse) / 3, second = (4 * fine - middle) / 3;
  return (16 * second - first) / 15;
}

void expectLowestEnergy(const Machine& machine, const Vector2d& bit, double within) {
  const Hang hang = reference::hangAt(machine, bit);
  ASSERT_TRUE(hang.solved);
  const Vector2d off = settleFinest(machine, hang) - bit;
  EXPECT_LT(off.norm(), within) << "at " << bit.transpose();
}

TEST(Energy, BeadsComeToRestWhereTheJudgeDoes) {
  expectLowestEnergy(defaultMachine(), {0, 0}, 1e-8);
  expectLowestEnergy(defaultMachine(), {0, 550}, 1e-8);
  expectLowestEnergy(defaultMachine(), {1150, -550}, 1e-8);
  expectLowestEnergy(defaultMachine(), {-1200, -600}, 1e-8);
}

TEST(Energy, BeadsAgreeOnALightSledWithALongArmAndUnlikeChains) {
  Machine machine = defaultMachine();
  machine.sled_weight = 60;
  machine.rotation_radius = 250;
  machine.left.weight = 0.0025;
  machine.left.compliance = 2e-5;
  expectLowestEnergy(machine, {700, -400}, 1e-8);
}

}  // namespace
