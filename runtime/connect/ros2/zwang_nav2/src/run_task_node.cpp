// <RunZwangTask task="align" params="push=30 N;timeout=20 s"/> in a behaviour tree of Nav2. Name the library
// zwang_run_task_bt_node in the navigator's `plugin_lib_names`. Not compiled by zwang's tests: Debian 12 has
// no Nav2. Humble has BehaviorTree.CPP 3, Jazzy has 4.
#if __has_include("behaviortree_cpp/bt_factory.h")
#include "behaviortree_cpp/bt_factory.h"
#else
#include "behaviortree_cpp_v3/bt_factory.h"
#endif

#include <memory>
#include <sstream>
#include <string>

#include "nav2_behavior_tree/bt_action_node.hpp"
#include "zwang_msgs/action/run_task.hpp"

namespace zwang_nav2 {

using RunTask = zwang_msgs::action::RunTask;

class RunZwangTask : public nav2_behavior_tree::BtActionNode<RunTask> {
 public:
  using BtActionNode::BtActionNode;

  static BT::PortsList providedPorts() {
    return providedBasicPorts(
        {BT::InputPort<std::string>("task", "a name of `tasks` in zwang's connection file"),
         BT::InputPort<std::string>("params", "", "`push=30 N;timeout=20 s`"),
         BT::OutputPort<std::string>("reason", "why the task is not done")});
  }

  void on_tick() override {
    std::string params, one;
    getInput("task", goal_.task);
    getInput("params", params);
    goal_.params.clear();
    for (std::istringstream all(params); std::getline(all, one, ';');) goal_.params.push_back(one);
  }

  BT::NodeStatus on_aborted() override {
    setOutput("reason", result_.result->reason);
    RCLCPP_WARN(node_->get_logger(), "zwang: %s", result_.result->reason.c_str());
    return BT::NodeStatus::FAILURE;
  }
};

}  // namespace zwang_nav2

BT_REGISTER_NODES(factory) {
  const BT::NodeBuilder builder = [](const std::string& name, const BT::NodeConfiguration& config) {
    return std::make_unique<zwang_nav2::RunZwangTask>(name, "/zwang/run", config);
  };
  factory.registerBuilder<zwang_nav2::RunZwangTask>("RunZwangTask", builder);
}
