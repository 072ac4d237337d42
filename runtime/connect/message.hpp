/// The messages of ROS 2 that a connection speaks. Each has one description of its fields, for both ways.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cdr.hpp"
#include "zwang/lang/connection.hpp"

namespace zwang::connect {

struct Header {
  std::int32_t seconds = 0;
  std::uint32_t nanoseconds = 0;
  std::string frame;

  double stamp() const { return seconds + 1e-9 * nanoseconds; }  ///< [s] since 1970
};
Header header_at(double stamp, const std::string& frame = {});

using Covariance = std::array<double, 36>;
/// x, y, z [m], then the quaternion x, y, z, w.
using PoseFields = std::array<double, 7>;
/// Linear, then angular: of a twist in m/s and rad/s, of a wrench in N and N m.
using SixFields = std::array<double, 6>;

struct JointState {
  Header header;
  std::vector<std::string> names;
  std::vector<double> positions, velocities, efforts;
};
struct Odometry {
  Header header;
  std::string child_frame;
  PoseFields pose{0, 0, 0, 0, 0, 0, 1};
  Covariance pose_covariance{};
  SixFields twist{};
  Covariance twist_covariance{};
};
struct Twist {
  SixFields twist{};
};
struct TwistStamped {
  Header header;
  SixFields twist{};
};
struct PoseStamped {
  Header header;
  PoseFields pose{0, 0, 0, 0, 0, 0, 1};
};
struct PoseWithCovarianceStamped {
  Header header;
  PoseFields pose{0, 0, 0, 0, 0, 0, 1};
  Covariance covariance{};
};
struct WrenchStamped {
  Header header;
  SixFields wrench{};
};
struct TransformStamped {
  Header header;
  std::string child_frame;
  PoseFields transform{0, 0, 0, 0, 0, 0, 1};
};
struct TransformsMessage {
  std::vector<TransformStamped> transforms;
};
/// rosgraph_msgs/Clock.
struct ClockMessage {
  std::int32_t seconds = 0;
  std::uint32_t nanoseconds = 0;

  double time() const { return seconds + 1e-9 * nanoseconds; }  ///< [s]
};
struct String {
  std::string data;
};
struct Bool {
  bool data = false;
};
struct Float64 {
  double data = 0.0;
};
struct Dimension {
  std::string label;
  std::uint32_t size = 0, stride = 0;
};
struct Float64MultiArray {
  std::vector<Dimension> dimensions;
  std::uint32_t offset = 0;
  std::vector<double> data;
};
struct KeyValue {
  std::string key, value;
};
/// diagnostic_msgs/DiagnosticStatus.
struct DiagnosticStatus {
  enum Level : std::uint8_t { ok, warn, error, stale };
  std::uint8_t level = ok;
  std::string name, message, hardware;
  std::vector<KeyValue> values;
};
struct DiagnosticArray {
  Header header;
  std::vector<DiagnosticStatus> status;
};
struct LaserScan {
  Header header;
  /// angle_min, angle_max, angle_increment [rad], time_increment, scan_time [s], range_min, range_max [m]
  std::array<float, 7> facts{};
  std::vector<float> ranges, intensities;

  /// [m] The nearest valid range between two angles [rad]; none: nothing is seen there.
  std::optional<double> nearest(double low, double high) const;
};

/// Into `bytes`, whose memory is used again.
template <typename Message>
void encode(const Message& message, Bytes& bytes);
/// nullopt for anything but this message, whole.
template <typename Message>
std::optional<Message> decode(std::span<const std::uint8_t> bytes);

/// Of a std_msgs/Bool 0 or 1, of a Float64 its number; nullopt for a bad one.
std::optional<double> read_output(lang::MessageType type, std::span<const std::uint8_t> payload);
/// None of them is NaN or infinite.
bool are_finite(std::span<const double> numbers);

/// As DDS knows it: `std_msgs::msg::dds_::String_` of `std_msgs/String`, `std_srvs::srv::dds_::Trigger_` of
/// `std_srvs/srv/Trigger`.
std::string dds_type(const std::string& name);
/// As DDS knows it: `rt/cmd_vel`.
std::string dds_topic(const std::string& topic);

}  // namespace zwang::connect
