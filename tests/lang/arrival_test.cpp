// N603 of drivers without a velocity range: how fast the base arrives.
#include <gtest/gtest.h>

#include <cmath>

#include "support.hpp"
#include "zwang/lang/notes.hpp"

namespace zwang::lang {
namespace {

/// tests/conformance/robots/mini: two wheels of 1 kg and 0.002 kg m^2, 0.1 m high, under 20 kg; 0.3 m ahead
/// of its origin its footprint ends. It starts 1 m before a wall of 100 kN/m at each of its two corners,
/// undamped.
constexpr double mini_mass = 20.0 + 2.0 + 2.0 * 0.002 / 0.01, mini_way = 0.7, two_corners = 2.0e5;

class Arrival : public testing::Test {
 protected:
  Arrival() {
    for (const char* name : {"mini.urdf", "mini.yaml"})
      folder_.write(std::string("robots/") + name,
                    test::slurp(test::source_dir / "tests/conformance/robots" / name));
    folder_.write(
        "wall.yaml",
        "zwang_scene: 1\nstart: {at: [0 m, 0 m], yaw: 0 deg}\nobjects:\n  w: {wall: {length: 4 m, "
        "thickness: 0.1 m, height: 1 m}, at: [1 m, 0 m], fixed: true, stiffness: 100 kN/m, damping: "
        "0}\n");
  }

  std::string forecast(const std::string& x, const std::string& in) {
    Diagnostics diagnostics;
    load_with_notes(
        folder_.write("task.yaml",
                      "zwang: 1\nrobot: robots/mini.yaml\nscene: wall.yaml\nstart: go\ntasks:\n  "
                      "go:\n    constraints:\n      go: {move: base_link, in: " +
                          in + ", x: {" + x +
                          "}, rz: {velocity: 0 rad/s}}\n    timeout: {after: 9 s, goto: failed}\n"),
        {}, diagnostics);
    for (const Diagnostic& d : diagnostics.all()) {
      if (d.code == "N603") return d.message;
    }
    return "";
  }

  test::Folder folder_;
};

/// v^2 = 2 a s from rest, and the driver presses on with F = m a: C = F + sqrt(F^2 + K m v^2).
double peak_at(double a) {
  const double F = mini_mass * a;
  return F + std::sqrt(F * F + two_corners * mini_mass * 2.0 * a * mini_way);
}

TEST_F(Arrival, without_a_range_has_the_speed_that_the_way_gives) {
  struct Driver {
    const char *x, *in;
    double acceleration;
  };
  for (const Driver& driver : {Driver{"acceleration: 0.3 m/s^2", "base_link", 0.3},
                               Driver{"force: 10 N", "base_link", 10.0 / mini_mass},
                               Driver{"position: 30 m, acceleration: +-0.2 m/s^2", "world", 0.2}}) {
    const std::string text = forecast(driver.x, driver.in);
    const std::size_t at = text.find("peaks near ");
    ASSERT_NE(at, std::string::npos) << driver.x << ": " << text;
    const double peak = peak_at(driver.acceleration);
    EXPECT_NEAR(std::stod(text.substr(at + 11)), peak, 0.005 * peak) << text;
  }
}

/// A velocity driver presses the harder the more the wall slows it: m x'' = m (v - x') / T - K x. From its
/// equilibrium s = m v / (T K), X = x - s is a damped swing with 2 z w = 1 / T.
TEST_F(Arrival, of_a_velocity_has_the_push_that_the_lost_speed_gives) {
  const double v = 0.15, T = 0.05;
  const double w = std::sqrt(two_corners / mini_mass), zw = 0.5 / T, d = std::sqrt(w * w - zw * zw);
  const double s = mini_mass * v / (T * two_corners);
  const double A = -s, B = (v - zw * s) / d;
  const double t = std::atan2(B * d - zw * A, A * d + zw * B) / d;  // X' = 0
  const double peak = two_corners * (s + std::exp(-zw * t) * (A * std::cos(d * t) + B * std::sin(d * t)));
  const std::string text = forecast("velocity: 0.15 m/s, time_constant: 50 ms", "base_link");
  const std::size_t at = text.find("peaks near ");
  ASSERT_NE(at, std::string::npos) << text;
  EXPECT_NEAR(std::stod(text.substr(at + 11)), peak, 0.01 * peak) << text;
}

TEST_F(Arrival, of_what_stops_before_the_wall_is_none) {
  EXPECT_EQ(forecast("position: 0.1 m, acceleration: +-0.2 m/s^2", "world"), "");
  EXPECT_EQ(forecast("position: 0 m", "world"), "");
}

}  // namespace
}  // namespace zwang::lang
