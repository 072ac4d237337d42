#!/usr/bin/env python3
"""Runs one task of `zwang drive` and prints why it ended.

    run_task.py TASK [NAME=VALUE]...

Ends with 0 when the task is done. Not run by zwang's tests: Debian 12 has no rclpy.
"""

import sys

import rclpy
from rclpy.action import ActionClient
from zwang_msgs.action import RunTask


def main():
    rclpy.init()
    node = rclpy.create_node("run_task")
    client = ActionClient(node, RunTask, "/zwang/run")
    client.wait_for_server()
    goal = RunTask.Goal(task=sys.argv[1], params=sys.argv[2:])
    sent = client.send_goal_async(
        goal, feedback_callback=lambda m: print(f"{m.feedback.elapsed:6.1f} s  {m.feedback.force:6.1f} N  {m.feedback.task}"))
    rclpy.spin_until_future_complete(node, sent)
    if not sent.result().accepted:
        sys.exit("not accepted: another goal runs, no samples come from the robot, or /zwang/reset is due")
    waited = sent.result().get_result_async()
    rclpy.spin_until_future_complete(node, waited)
    result = waited.result().result
    print("done" if result.outcome == RunTask.Result.DONE else result.reason)
    sys.exit(0 if result.outcome == RunTask.Result.DONE else 1)


if __name__ == "__main__":
    main()
