#include <cctype>

#include "connection/connection_file.hpp"
#include "diagnostic/wordings_connection.hpp"
#include "tree/file.hpp"
#include "tree/read.hpp"
#include "zwang/lang/connection.hpp"

namespace zwang::lang {

namespace {

struct NamedTopic {
  const Topic& topic;
  MessageType type;
  bool is_sent;
};

std::vector<NamedTopic> topics_of(const Connection& c) {
  std::vector<NamedTopic> all{{c.joints.topic, MessageType::joint_state, false},
                              {c.command.topic, c.command.type, true}};
  if (c.base) all.push_back({*c.base, MessageType::odometry, false});
  if (c.fix) all.push_back({*c.fix, MessageType::pose_with_covariance_stamped, false});
  if (c.publication && c.publication->odometry)
    all.push_back({*c.publication->odometry, MessageType::odometry, true});
  if (c.wrench) all.push_back({*c.wrench, MessageType::wrench_stamped, false});
  if (c.clock) all.push_back({*c.clock, MessageType::clock, false});
  for (const SignalSource& signal : c.signals) all.push_back({signal.topic, signal.type, false});
  for (const OutputSink& output : c.outputs) all.push_back({output.topic, output.type, true});
  return all;
}

/// Two signals may read one topic, as two sectors of a scan. Each sent message has a topic of its own.
void check_topics(const Connection& connection, Diagnostics& diagnostics) {
  const std::vector<NamedTopic> all = topics_of(connection);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const bool can_share = all[i].type == all[j].type && !all[i].is_sent && !all[j].is_sent;
      if (all[i].topic.name.empty() || all[i].topic.name != all[j].topic.name || can_share) continue;
      diagnostics.add(wording::topic_twice(all[i].topic.span, all[i].topic.name, all[j].topic.span));
      break;
    }
  }
}

}  // namespace

const char* to_string(MessageType type) noexcept {
  switch (type) {
    case MessageType::joint_state:
      return "sensor_msgs/JointState";
    case MessageType::odometry:
      return "nav_msgs/Odometry";
    case MessageType::twist:
      return "geometry_msgs/Twist";
    case MessageType::twist_stamped:
      return "geometry_msgs/TwistStamped";
    case MessageType::pose_stamped:
      return "geometry_msgs/PoseStamped";
    case MessageType::pose_with_covariance_stamped:
      return "geometry_msgs/PoseWithCovarianceStamped";
    case MessageType::wrench_stamped:
      return "geometry_msgs/WrenchStamped";
    case MessageType::boolean:
      return "std_msgs/Bool";
    case MessageType::float64:
      return "std_msgs/Float64";
    case MessageType::float64_multi_array:
      return "std_msgs/Float64MultiArray";
    case MessageType::tf_message:
      return "tf2_msgs/TFMessage";
    case MessageType::clock:
      return "rosgraph_msgs/Clock";
    case MessageType::laser_scan:
      break;
  }
  return "sensor_msgs/LaserScan";
}

bool is_topic_name(std::string_view name) {
  if (name.size() < 2 || name.size() > 240 || name.front() != '/' || name.back() == '/') return false;
  char before = 'a';
  for (const char c : name) {
    const bool is_letter = std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
    const bool is_digit = c >= '0' && c <= '9';
    if (!is_letter && !is_digit && c != '/') return false;
    if (before == '/' && !is_letter) return false;
    if (before == '_' && c == '_') return false;
    before = c;
  }
  return true;
}

std::optional<Connection> load_connection(const std::filesystem::path& path, Diagnostics& diagnostics) {
  const int errors_before = diagnostics.error_count();
  const std::optional<int> source = read_file(path, yaml_size_limit, {}, diagnostics);
  if (!source) return std::nullopt;
  const std::optional<Document> document = read(*source, diagnostics);
  std::optional<Connection> connection;
  if (document) connection = parse_connection(*document, path.parent_path(), diagnostics);
  if (connection) check_topics(*connection, diagnostics);
  diagnostics.settle();
  if (!connection || diagnostics.error_count() > errors_before) return std::nullopt;
  connection->path = path.string();
  return connection;
}

}  // namespace zwang::lang
