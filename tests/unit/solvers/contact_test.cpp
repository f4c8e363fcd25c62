#include "core/solvers/contact.hpp"

#include <random>

#include <gtest/gtest.h>

namespace perifrac {
namespace {

/// Of n pieces of a crack, as an elastic body has it: every opening feels every pressure.
Eigen::MatrixXd compliance_of(int n) {
  Eigen::MatrixXd compliance(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) compliance(i, j) = 1.0 / (1.0 + std::abs(i - j));
  }
  return compliance;
}

/// Openings and pressures that are never below zero, and nowhere both above it.
TEST(Contact, HoldsApartWhatWouldOverlapAndNothingElse) {
  std::mt19937 random(7);
  std::normal_distribution<double> any;
  const Eigen::MatrixXd compliance = compliance_of(12);
  int closed = 0;
  for (int n = 0; n < 50; ++n) {
    const Eigen::VectorXd free = Eigen::VectorXd::NullaryExpr(12, [&] { return any(random); });
    const Contact contact = find_contact(free, compliance, 1e-14);
    EXPECT_GE(contact.opening.minCoeff(), -1e-14);
    EXPECT_GE(contact.pressure.minCoeff(), 0.0);
    EXPECT_EQ(contact.opening.cwiseProduct(contact.pressure).cwiseAbs().maxCoeff(), 0.0);
    const Eigen::VectorXd opening = free + compliance * contact.pressure;
    EXPECT_LE((opening - contact.opening).cwiseAbs().maxCoeff(), 1e-12);
    closed += static_cast<int>(contact.closed.size());
  }
  EXPECT_GT(closed, 100);
}

TEST(Contact, LeavesOpenFacesAlone) {
  const Eigen::VectorXd free = Eigen::VectorXd::LinSpaced(5, 0.0, 1.0);
  const Contact contact = find_contact(free, compliance_of(5), 1e-14);
  EXPECT_EQ(contact.opening, free);
  EXPECT_TRUE(contact.closed.empty());
  EXPECT_EQ(compliance_beside(contact.closed, compliance_of(5)), compliance_of(5));
}

/// A width that does not answer to pressure is as it is given.
TEST(Contact, PressesOnlyWhereThatHelps) {
  const Eigen::VectorXd free = Eigen::VectorXd::Constant(3, -1.0);
  const Contact contact = find_contact(free, Eigen::MatrixXd::Zero(3, 3), 1e-14);
  EXPECT_EQ(contact.opening, free);
  EXPECT_EQ(contact.pressure.norm(), 0.0);
}

TEST(Contact, TellsHowOpeningsAnswerBesideClosedFaces) {
  const Eigen::MatrixXd compliance = compliance_of(8);
  Eigen::VectorXd free(8);
  free << 1.0, 0.8, 0.3, -0.4, -0.5, 0.2, 0.9, -1.0;
  const Contact contact = find_contact(free, compliance, 1e-14);
  ASSERT_FALSE(contact.closed.empty());
  const Eigen::MatrixXd slope = compliance_beside(contact.closed, compliance);
  for (int f = 0; f < 8; ++f) {
    const Eigen::VectorXd more = free + 1e-7 * compliance.col(f);
    const Eigen::VectorXd change =
        (find_contact(more, compliance, 1e-14).opening - contact.opening) / 1e-7;
    EXPECT_LE((change - slope.col(f)).cwiseAbs().maxCoeff(), 1e-6) << f;
  }
}

}  // namespace
}  // namespace perifrac
