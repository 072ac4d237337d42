#include "message.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace zwang::connect {

namespace {

// `Way` is CdrWriter or CdrReader. The order is that of the .msg files.
template <typename Way>
struct Fields {
  Way& way;

  template <typename T>
  void operator()(T& value) {
    way(value);
  }
  template <typename H>
  requires std::is_same_v<std::remove_const_t<H>, Header>
  void operator()(H& header) { way(header.seconds), way(header.nanoseconds), way(header.frame); }
};

template <typename Way, typename... Values>
void pass(Way& way, Values&... values) {
  Fields<Way> fields{way};
  (fields(values), ...);
}

template <typename Way, typename M>
void describe(Way& way, M& m) {
  using Message = std::remove_const_t<M>;
  if constexpr (std::is_same_v<Message, JointState>) {
    pass(way, m.header, m.names, m.positions, m.velocities, m.efforts);
  } else if constexpr (std::is_same_v<Message, Odometry>) {
    pass(way, m.header, m.child_frame, m.pose, m.pose_covariance, m.twist, m.twist_covariance);
  } else if constexpr (std::is_same_v<Message, ClockMessage>) {
    pass(way, m.seconds, m.nanoseconds);
  } else if constexpr (std::is_same_v<Message, Twist>) {
    pass(way, m.twist);
  } else if constexpr (std::is_same_v<Message, TwistStamped>) {
    pass(way, m.header, m.twist);
  } else if constexpr (std::is_same_v<Message, PoseStamped>) {
    pass(way, m.header, m.pose);
  } else if constexpr (std::is_same_v<Message, PoseWithCovarianceStamped>) {
    pass(way, m.header, m.pose, m.covariance);
  } else if constexpr (std::is_same_v<Message, WrenchStamped>) {
    pass(way, m.header, m.wrench);
  } else if constexpr (std::is_same_v<Message, LaserScan>) {
    pass(way, m.header, m.facts, m.ranges, m.intensities);
  } else {
    pass(way, m.data);
  }
}

void describe(CdrWriter& way, const Float64MultiArray& m) {
  way(static_cast<std::uint32_t>(m.dimensions.size()));
  for (const Dimension& d : m.dimensions) pass(way, d.label, d.size, d.stride);
  pass(way, m.offset, m.data);
}

void describe(CdrReader& way, Float64MultiArray& m) {
  std::uint32_t count = 0;
  way(count);
  for (std::uint32_t i = 0; i < count && way.is_good(); ++i) {
    Dimension& d = m.dimensions.emplace_back();
    pass(way, d.label, d.size, d.stride);
  }
  pass(way, m.offset, m.data);
}

void describe(CdrWriter& way, const TransformsMessage& m) {
  way(static_cast<std::uint32_t>(m.transforms.size()));
  for (const TransformStamped& t : m.transforms) pass(way, t.header, t.child_frame, t.transform);
}

void describe(CdrReader& way, TransformsMessage& m) {
  std::uint32_t count = 0;
  way(count);
  for (std::uint32_t i = 0; i < count && way.is_good(); ++i) {
    TransformStamped& t = m.transforms.emplace_back();
    pass(way, t.header, t.child_frame, t.transform);
  }
}

void describe(CdrWriter& way, const DiagnosticArray& m) {
  pass(way, m.header);
  way(static_cast<std::uint32_t>(m.status.size()));
  for (const DiagnosticStatus& s : m.status) {
    pass(way, s.level, s.name, s.message, s.hardware);
    way(static_cast<std::uint32_t>(s.values.size()));
    for (const KeyValue& v : s.values) pass(way, v.key, v.value);
  }
}

}  // namespace

template <typename Message>
void encode(const Message& message, Bytes& bytes) {
  CdrWriter way(bytes);
  describe(way, message);
}

template <typename Message>
std::optional<Message> decode(std::span<const std::uint8_t> bytes) {
  CdrReader way(bytes);
  std::optional<Message> message(std::in_place);
  if (way.is_good()) describe(way, *message);
  if (!way.is_at_end()) message.reset();
  return message;
}

#define ZWANG_BOTH_WAYS(Message)                \
  template void encode(const Message&, Bytes&); \
  template std::optional<Message> decode(std::span<const std::uint8_t>)
ZWANG_BOTH_WAYS(JointState);
ZWANG_BOTH_WAYS(Odometry);
ZWANG_BOTH_WAYS(Twist);
ZWANG_BOTH_WAYS(TwistStamped);
ZWANG_BOTH_WAYS(PoseStamped);
ZWANG_BOTH_WAYS(PoseWithCovarianceStamped);
ZWANG_BOTH_WAYS(WrenchStamped);
ZWANG_BOTH_WAYS(String);
ZWANG_BOTH_WAYS(Bool);
ZWANG_BOTH_WAYS(Float64);
ZWANG_BOTH_WAYS(Float64MultiArray);
ZWANG_BOTH_WAYS(LaserScan);
ZWANG_BOTH_WAYS(ClockMessage);
ZWANG_BOTH_WAYS(TransformsMessage);
#undef ZWANG_BOTH_WAYS
template void encode(const DiagnosticArray&, Bytes&);

Header header_at(double stamp, const std::string& frame) {
  const double seconds = std::floor(stamp);
  const double rest = std::min(std::round((stamp - seconds) * 1e9), 999'999'999.0);
  return {static_cast<std::int32_t>(seconds), static_cast<std::uint32_t>(rest), frame};
}

std::optional<double> LaserScan::nearest(double low, double high) const {
  std::optional<double> nearest;
  const auto [first, last, step, by, in, least, most] = facts;
  // Some scanners count from 0 to 2 pi, others from -pi to pi.
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double angle = static_cast<double>(first) + static_cast<double>(i) * static_cast<double>(step);
    const double range = static_cast<double>(ranges[i]);
    const bool is_valid = range >= static_cast<double>(least) && range <= static_cast<double>(most);
    if (!is_valid || std::abs(std::remainder(angle - middle, 2.0 * std::numbers::pi)) > half) continue;
    nearest = std::min(nearest.value_or(range), range);
  }
  return nearest;
}

std::optional<double> read_output(lang::MessageType type, std::span<const std::uint8_t> payload) {
  if (type == lang::MessageType::float64) {
    const auto message = decode<Float64>(payload);
    return message && std::isfinite(message->data) ? std::optional(message->data) : std::nullopt;
  }
  const auto message = decode<Bool>(payload);
  return message ? std::optional(message->data ? 1.0 : 0.0) : std::nullopt;
}

bool are_finite(std::span<const double> numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

std::string dds_type(const std::string& name) {
  const std::size_t first = name.find('/'), last = name.rfind('/');
  const std::string kind = first == last ? "msg" : name.substr(first + 1, last - first - 1);
  return name.substr(0, first) + "::" + kind + "::dds_::" + name.substr(last + 1) + "_";
}

std::string dds_topic(const std::string& topic) {
  return "rt" + topic;
}

}  // namespace zwang::connect
