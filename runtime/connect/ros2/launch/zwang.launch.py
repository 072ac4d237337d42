"""Starts `zwang drive`. Not run by zwang's tests: Debian 12 has no ROS 2."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess
from launch.substitutions import LaunchConfiguration


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("task", description="a task file"),
        DeclareLaunchArgument("connection", description="a connection file, with `start: goals` for actions"),
        DeclareLaunchArgument("wait", default_value="60", description="seconds for the robot to be there"),
        ExecuteProcess(
            cmd=["zwang", "drive", LaunchConfiguration("task"), "--over", LaunchConfiguration("connection"),
                 "--wait", LaunchConfiguration("wait")],
            output="screen",
            # Ctrl-C is the request to brake: it takes up to 2 s.
            sigterm_timeout="5"),
    ])
