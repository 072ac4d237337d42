// The parameter services, by the layouts of rcl_interfaces.
#include "parameters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace zwang::connect {
namespace {

constexpr std::uint8_t integer = 2, number = 3, text = 4;

struct Wish {
  std::string name;
  std::uint8_t type;
  std::int64_t integer_value;
  double number_value;
};

/// rcl_interfaces/Parameter[]: a value has all ten fields, whatever its type is.
Bytes wishes(const std::vector<Wish>& all) {
  Bytes bytes;
  CdrWriter write(bytes);
  write(static_cast<std::uint32_t>(all.size()));
  for (const Wish& wish : all) {
    write(wish.name), write(wish.type), write(false), write(wish.integer_value), write(wish.number_value);
    write(std::string());
    for (int list = 0; list < 5; ++list) write(std::uint32_t{0});
  }
  return bytes;
}

Bytes names(const std::vector<std::string>& all) {
  Bytes bytes;
  CdrWriter write(bytes);
  write(all);
  return bytes;
}

class Parameters : public testing::Test {
 protected:
  Parameters() {
    program.parameters.push_back({"push", 20.0, solver::Range{5.0, 40.0}, "N", 1.0, "how hard", {}});
    program.parameters.push_back({"speed", 0.1, std::nullopt, "cm/s", 0.01, "", {}});
    server.serve_for(program);
  }

  Bytes ask(void (ParameterServer::*handle)(std::span<const std::uint8_t>, const Reply&),
            const Bytes& fields) {
    Bytes answer;
    (server.*handle)(fields, [&](const Bytes& bytes) { answer = bytes; });
    return answer;
  }

  std::vector<std::pair<bool, std::string>> set(const std::vector<Wish>& all) {
    const Bytes answer = ask(&ParameterServer::set, wishes(all));
    CdrReader read(answer);
    std::uint32_t count = 0;
    read(count);
    std::vector<std::pair<bool, std::string>> results(count);
    for (auto& [good, reason] : results) read(good), read(reason);
    EXPECT_TRUE(read.is_at_end());
    return results;
  }

  double value_of(const std::string& name) {
    const Bytes answer = ask(&ParameterServer::get, names({name}));
    CdrReader read(answer);
    std::uint32_t count = 0;
    std::uint8_t type = 0;
    bool boolean = false;
    std::int64_t whole = 0;
    double value = 0.0;
    read(count), read(type), read(boolean), read(whole), read(value);
    return type == number ? value : std::nan("");
  }

  lang::Program program;
  ParameterServer server;
};

TEST_F(Parameters, AreListedWithTheirRanges) {
  Bytes request;
  CdrWriter write(request);
  write(std::vector<std::string>()), write(std::uint64_t{0});
  const Bytes answer = ask(&ParameterServer::list, request);
  CdrReader list(answer);
  std::vector<std::string> found, prefixes;
  list(found), list(prefixes);
  EXPECT_TRUE(list.is_at_end());
  EXPECT_EQ(found, (std::vector<std::string>{"push", "speed"}));

  const Bytes described = ask(&ParameterServer::describe, names({"push"}));
  CdrReader read(described);
  std::uint32_t count = 0, ranges = 0, integer_ranges = 9;
  std::string name, description, constraints;
  std::uint8_t type = 0;
  bool is_read_only = true, is_dynamic = true;
  double low = 0.0, high = 0.0, step = 1.0;
  read(count), read(name), read(type), read(description), read(constraints), read(is_read_only),
      read(is_dynamic);
  read(ranges), read(low), read(high), read(step), read(integer_ranges);
  EXPECT_TRUE(read.is_at_end());
  EXPECT_EQ(count, 1U);
  EXPECT_EQ(name, "push");
  EXPECT_EQ(type, number);
  EXPECT_EQ(description, "how hard");
  EXPECT_FALSE(is_read_only || is_dynamic);
  EXPECT_EQ(ranges, 1U);
  EXPECT_EQ(low, 5.0);
  EXPECT_EQ(high, 40.0);
  EXPECT_EQ(integer_ranges, 0U);
}

TEST_F(Parameters, AreSetWithinTheirRanges) {
  const auto results = set({{"push", number, 0, 30.0},
                            {"speed", integer, 2, 0.0},
                            {"push", number, 0, 41.0},
                            {"push", number, 0, NAN},
                            {"push", text, 0, 10.0},
                            {"pull", number, 0, 10.0}});
  ASSERT_EQ(results.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(results[i].first, i < 2) << i;
    EXPECT_EQ(results[i].second.empty(), i < 2) << i;
  }
  EXPECT_EQ(value_of("push"), 30.0);
  EXPECT_EQ(value_of("speed"), 2.0);
  EXPECT_TRUE(std::isnan(value_of("pull")));
}

TEST_F(Parameters, ReachTheControlThreadOnce) {
  set({{"speed", number, 0, 0.2}, {"push", number, 0, 30.0}, {"push", number, 0, 25.0}});
  const auto first = server.take_change(), second = server.take_change();
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->parameter, 0U);
  EXPECT_EQ(first->value, 25.0);
  EXPECT_EQ(second->parameter, 1U);
  EXPECT_EQ(second->value, 0.2);
  EXPECT_FALSE(server.take_change());
}

TEST_F(Parameters, AreSetTogetherOrNotAtAll) {
  const auto is_set = [&](const std::vector<Wish>& all) {
    const Bytes answer = ask(&ParameterServer::set_atomically, wishes(all));
    CdrReader read(answer);
    bool is_good = false;
    std::string reason;
    read(is_good), read(reason);
    EXPECT_TRUE(read.is_at_end());
    return is_good;
  };
  EXPECT_FALSE(is_set({{"push", number, 0, 30.0}, {"push", number, 0, 1.0}}));
  EXPECT_EQ(value_of("push"), 20.0);
  EXPECT_TRUE(is_set({{"push", number, 0, 30.0}, {"speed", number, 0, 0.3}}));
  EXPECT_EQ(value_of("push"), 30.0);
  EXPECT_EQ(value_of("speed"), 0.3);
}

TEST_F(Parameters, SurviveAnyBytes) {
  std::mt19937 random(24);
  const std::vector<Bytes> seeds{wishes({{"push", number, 0, 30.0}}), names({"push", "speed"})};
  for (int i = 0; i < 20'000; ++i) {
    Bytes bytes = seeds[random() % seeds.size()];
    for (unsigned changes = random() % 8; changes > 0; --changes)
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    bytes.resize(random() % (bytes.size() + 1));
    for (const ParameterService& service : parameter_services) ask(service.handle, bytes);
  }
  EXPECT_GE(value_of("push"), 5.0);
  EXPECT_LE(value_of("push"), 40.0);
}

}  // namespace
}  // namespace zwang::connect
