/// A connection file: over which ROS 2 topics a robot is sensed and commanded.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "zwang/export.hpp"
#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

struct Program;

/// The messages that a connection can name or use.
enum class MessageType {
  joint_state,
  odometry,
  twist,
  twist_stamped,
  pose_stamped,
  pose_with_covariance_stamped,
  wrench_stamped,
  boolean,
  float64,
  float64_multi_array,
  laser_scan,
  tf_message,
  clock,
};
/// As ROS 2 writes it: `geometry_msgs/Twist`.
ZWANG_EXPORT const char* to_string(MessageType type) noexcept;

/// The machines that the robot may be on.
enum class Reach {
  loopback,  ///< 127.0.0.1 alone: peers need ROS_LOCALHOST_ONLY=1
  machine,   ///< every interface; only processes of this machine are obeyed, and hear of this one
  network,   ///< every interface of this machine, or those that the file names
};

/// The name of a ROS 2 topic, and where the file says it.
struct Topic {
  std::string name;  ///< absolute: `/joint_states`
  Span span;
};

/// [s] A robot that has said nothing for so long is given up: the run ends, and nobody brakes any more.
inline constexpr double given_up_after = 2.0;

/// sensor_msgs/JointState.
struct JointsSource {
  Topic topic;
  double stale_after = 0.0;                  ///< [s] without a new sample until the robot is stopped
  Span stale_span;                           ///< where the file says it
  std::map<std::string, std::string> names;  ///< the URDF's joint -> its name in the messages
  std::map<std::string, Span> name_spans;    ///< by the URDF's joint

  /// The name that the messages have for the URDF's joint.
  const std::string& name_of(const std::string& joint) const {
    const auto renamed = names.find(joint);
    return renamed == names.end() ? joint : renamed->second;
  }
};

/// The pose of `child` in `parent`, from the transforms on /tf and /tf_static.
struct FramePair {
  std::string parent, child;
  Span span;
};

/// The topic that brings a signal of the task file.
struct SignalSource {
  std::string name;  ///< the task file's
  Topic topic;
  MessageType type = MessageType::boolean;
  /// Of a LaserScan: the nearest range between these angles [rad].
  std::optional<std::array<double, 2>> nearest;
  Span span;
};

/// Where a task's output goes: a bool, or a number in SI.
struct OutputSink {
  std::string name;  ///< the task file's
  Topic topic;
  MessageType type = MessageType::boolean;  ///< or float64
  Span span;
};

/// The topics on which other programs read the base's motion.
struct BasePublication {
  std::optional<Topic> odometry;    ///< nav_msgs/Odometry
  std::optional<FramePair> frames;  ///< of a transform on /tf
  double rate = 50.0;               ///< [1/s]
};

/// The command that the robot takes: a twist of the base, torques or velocities of joints.
enum class CommandKind { twist, effort, velocity };

/// The topic that the commands go to.
struct CommandSink {
  CommandKind kind = CommandKind::twist;
  MessageType type = MessageType::twist;  ///< of a twist; joints take a Float64MultiArray
  Topic topic;
  std::optional<double> rate;  ///< [1/s] of a twist; none: once a control period
  Span rate_span;
  std::optional<double> timeout;  ///< [s] after which the receiver stops by itself; none: it does not
  Span timeout_span;
  std::vector<std::string> order;  ///< joints of a Float64MultiArray
  std::vector<Span> order_spans;
  Span span;
};

/// A task that a goal of the action `run` can name.
struct NamedTask {
  std::string name;
  std::filesystem::path file;  ///< from the folder of the connection file, where it is not absolute
  Span span;
};

/// The moment at which a task begins.
enum class Begin {
  at_once,  ///< the task begins as soon as the robot is there
  service,  ///< with the service `start`
  goals,    ///< each goal of the action `run` begins a task
};

/// A checked connection file. Times are in s, rates in 1/s.
struct Connection {
  std::string path;             ///< as it was opened
  int domain = 0;               ///< ROS_DOMAIN_ID
  std::string name = "/zwang";  ///< before the names of the own services and topics: `/zwang/start`
  Begin begin = Begin::at_once;
  std::vector<NamedTask> tasks;  ///< with `Begin::goals`
  Reach reach = Reach::loopback;
  std::vector<std::string> interfaces;  ///< of `Reach::network`, as `eth0`; empty: all
  /// rosgraph_msgs/Clock, by which all stamps and ticks go; none: the computer's clock.
  std::optional<Topic> clock;
  JointsSource joints;
  std::optional<Topic> base;  ///< nav_msgs/Odometry; none: the base is reckoned from its wheels
  /// The base's pose in the world, now and then: geometry_msgs/PoseWithCovarianceStamped, or by transforms.
  std::optional<Topic> fix;
  std::optional<FramePair> fix_frames;  ///< instead of `fix`
  /// geometry_msgs/WrenchStamped: what presses on a robot that `feels` by a wrench, in the sensor's frame.
  std::optional<Topic> wrench;
  std::vector<SignalSource> signals;
  std::vector<OutputSink> outputs;
  std::optional<BasePublication> publication;
  CommandSink command;
  int priority = 0;  ///< of SCHED_FIFO; 0: the usual scheduler
};

/// Whether ROS 2 takes it as an absolute topic name.
ZWANG_EXPORT bool is_topic_name(std::string_view name);

/// Reads and checks a connection file by itself. On any error nullopt, and the diagnostics say why.
ZWANG_EXPORT std::optional<Connection> load_connection(const std::filesystem::path& path,
                                                       Diagnostics& diagnostics);

/// Whether the connection gives a program all that it reads, and takes what its drive sends. If not, the
/// diagnostics say why: E301, E922, E923.
ZWANG_EXPORT bool check_connection(const Connection& connection, const Program& program,
                                   Diagnostics& diagnostics);

}  // namespace zwang::lang
