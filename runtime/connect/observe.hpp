/// `zwang drive --observe`: what comes, how often, how late, and whether its signs agree. Nothing is sent.
#pragma once

#include "inbox.hpp"

namespace zwang::connect {

/// A line for each topic.
void print_topics(const Inbox& inbox);
/// Looks for so long [s], then reports. The exit code: 1 when a topic is silent or a sign contradicts.
int observe(const lang::Connection& connection, const lang::Program& program, Inbox& inbox, double seconds);

}  // namespace zwang::connect
