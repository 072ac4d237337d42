/// The parameter services of a ROS 2 node, for the `params` of the task file that runs. It knows no DDS.
#pragma once

#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "service.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::connect {

/// Any thread may call it. All parameters are doubles in SI, within the ranges of the task file.
class ParameterServer {
 public:
  struct Change {
    std::size_t parameter = 0;  ///< in Program::parameters
    double value = 0.0;         ///< SI
  };

  /// From now on it speaks of the parameters of this program, as they stand in it.
  void serve_for(const lang::Program& program);
  /// The changes by a person since the last call, one parameter a call. Of the control thread: it neither
  /// waits nor allocates.
  std::optional<Change> take_change() noexcept;

  // Services of rcl_interfaces, each between a request's fields and the reply.
  void list(std::span<const std::uint8_t> fields, const Reply& reply);
  void get(std::span<const std::uint8_t> fields, const Reply& reply);
  void get_types(std::span<const std::uint8_t> fields, const Reply& reply);
  void describe(std::span<const std::uint8_t> fields, const Reply& reply);
  void set(std::span<const std::uint8_t> fields, const Reply& reply);
  void set_atomically(std::span<const std::uint8_t> fields, const Reply& reply);

 private:
  struct Known {
    lang::Parameter parameter;
    bool is_changed = false;  ///< and the control thread has not taken it
  };
  struct Wanted {
    std::string name;
    std::optional<double> value;  ///< none: it is not a number
  };
  struct Verdict {
    bool successful = true;
    std::string reason;
  };

  static std::optional<std::vector<Wanted>> read_wanted(std::span<const std::uint8_t> fields);
  static std::uint8_t type_of(const Known* known);
  Known* find(const std::string& name);
  template <typename Tell>
  void answer_each(std::span<const std::uint8_t> fields, const Reply& reply, Tell tell);
  Verdict judge(const Wanted& wanted);
  void take(const Wanted& wanted);

  std::mutex mutex_;
  std::vector<Known> known_;
};

struct ParameterService {
  const char* name;
  const char* type;
  void (ParameterServer::*handle)(std::span<const std::uint8_t>, const Reply&);
};
inline constexpr ParameterService parameter_services[] = {
    {"list_parameters", "rcl_interfaces/srv/ListParameters", &ParameterServer::list},
    {"get_parameters", "rcl_interfaces/srv/GetParameters", &ParameterServer::get},
    {"get_parameter_types", "rcl_interfaces/srv/GetParameterTypes", &ParameterServer::get_types},
    {"describe_parameters", "rcl_interfaces/srv/DescribeParameters", &ParameterServer::describe},
    {"set_parameters", "rcl_interfaces/srv/SetParameters", &ParameterServer::set},
    {"set_parameters_atomically", "rcl_interfaces/srv/SetParametersAtomically",
     &ParameterServer::set_atomically},
};

}  // namespace zwang::connect
