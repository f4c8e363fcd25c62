#pragma once

namespace perifrac {

/// The Gaussian influence exp(-(r / 0.4 horizon)^2), 0 beyond the horizon, as a function of r^2
/// alone: both ends of a pair get the same bits. Within 1e-12 of std::exp in a fraction of its
/// time.
class GaussianInfluence {
 public:
  /// `horizon` in [m].
  explicit GaussianInfluence(double horizon)
      : square_reach_(horizon * horizon * (1.0 + slack)),
        scale_(-1.0 / (0.16 * horizon * horizon * power)) {}

  /// omega at r^2 [m^2]; Number is double or Packet.
  template <class Number>
  Number operator()(const Number& r_square) const {
    // exp(power t) = exp(t)^power: with |t| < 0.05 seven terms of its series are enough.
    const Number t = r_square * scale_, t2 = t * t, t4 = t2 * t2;
    Number omega = (1.0 + t + (1.0 / 2.0 + t * (1.0 / 6.0)) * t2) +
                   (1.0 / 24.0 + t * (1.0 / 120.0) + (1.0 / 720.0 + t * (1.0 / 5040.0)) * t2) * t4;
    for (int n = 1; n < power; n *= 2) omega *= omega;
    return r_square < square_reach_ ? omega : Number{};
  }

 private:
  static constexpr int power = 128;
  static constexpr double slack = 2e-9;  // distances that equal the horizon are in, rounded or not

  double square_reach_;
  double scale_;
};

}  // namespace perifrac
