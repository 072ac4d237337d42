// A study on several ranks: each cell once, whatever becomes of the others, and nobody works on another
// study. Sockets stand in for MPI; `study.process` has mpirun itself.
#include "study/ranks.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <map>
#include <stdexcept>

#include "made_cells.hpp"

namespace zwang::study {
namespace {

/// One socket to each other rank that is spoken to.
class SocketMessages : public Messages {
 public:
  SocketMessages(int rank, std::map<int, int> sockets)
      : rank_(rank), size_(static_cast<int>(sockets.size()) + 1), sockets_(std::move(sockets)) {}
  int rank() const override { return rank_; }
  int size() const override { return size_; }
  void send(int to, const std::string& text) override {
    ::send(sockets_.at(to), text.data(), text.size(), 0);
  }
  std::optional<Message> receive(double most) override {
    std::vector<pollfd> files;
    std::vector<int> ranks;
    for (const auto& [rank, socket] : sockets_) {
      files.push_back({socket, POLLIN, 0});
      ranks.push_back(rank);
    }
    ::poll(files.data(), files.size(), static_cast<int>(1e3 * most));
    for (std::size_t i = 0; i < files.size(); ++i) {
      if ((files[i].revents & POLLIN) == 0) continue;
      std::string text(1 << 16, '\0');
      const ssize_t size = ::recv(files[i].fd, text.data(), text.size(), 0);
      if (size <= 0) {  // it has ended
        sockets_.erase(ranks[i]);
        if (sockets_.empty() && rank_ > 0) throw std::runtime_error("rank 0 has ended");
        continue;
      }
      text.resize(static_cast<std::size_t>(size));
      return Message{ranks[i], text};
    }
    return std::nullopt;
  }

 private:
  int rank_, size_;
  std::map<int, int> sockets_;
};

/// Cells of which one takes its process along.
WorkCalls calls_with_a_crash(std::map<std::size_t, std::string>& outcomes) {
  WorkCalls calls = calls_of(outcomes);
  calls.run = [](std::size_t cell) {
    if (cell == 7) ::kill(::getpid(), SIGKILL);
    return made_outcome(cell, "done");
  };
  return calls;
}

/// Rank 0 of three; the other two are processes that have read studies of these identities.
std::map<std::size_t, std::string> outcomes_with(const std::array<std::string, 2>& identities,
                                                 std::size_t own_processes) {
  std::map<std::size_t, std::string> outcomes;
  std::map<int, int> sockets;
  std::vector<pid_t> others;
  for (int rank = 1; rank <= 2; ++rank) {
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends) != 0) throw std::runtime_error("no sockets");
    const pid_t other = ::fork();
    if (other == 0) {
      try {
        SocketMessages messages(rank, {{0, ends[1]}});
        serve_rank({}, calls_with_a_crash(outcomes), identities[static_cast<std::size_t>(rank) - 1],
                   messages);
      } catch (const std::exception&) {
        ::_exit(1);
      }
      ::_exit(0);
    }
    ::close(ends[1]);
    sockets[rank] = ends[0];
    others.push_back(other);
  }
  SocketMessages messages(0, sockets);
  std::string problem;
  try {
    run_with_ranks(first_cells(60), {.processes = own_processes}, calls_with_a_crash(outcomes), "this study",
                   messages);
  } catch (const std::runtime_error& error) {
    problem = error.what();
    for (const pid_t other : others) ::kill(other, SIGKILL);
  }
  for (const pid_t other : others) ::waitpid(other, nullptr, 0);
  for (const auto& [rank, socket] : sockets) ::close(socket);
  if (!problem.empty()) throw std::runtime_error(problem);
  return outcomes;
}

TEST(Ranks, RunEachCellOnceAndTellOfOneThatCrashes) {
  for (const std::size_t own : {0U, 2U}) {
    const auto outcomes = outcomes_with({"this study", "this study"}, own);
    ASSERT_EQ(outcomes.size(), 60u);
    for (const auto& [cell, outcome] : outcomes) EXPECT_EQ(outcome, cell == 7 ? "crashed" : "done") << cell;
  }
}

TEST(Ranks, RefuseOneThatHasReadAnotherStudy) {
  EXPECT_THROW(outcomes_with({"this study", "another one"}, 1), std::runtime_error);
}

/// Rank 0 and rank 2 cannot read the study, rank 1 can: all three end.
TEST(Ranks, EndWithoutAStudy) {
  std::map<int, int> sockets;
  std::vector<pid_t> others;
  for (int rank = 1; rank <= 2; ++rank) {
    int ends[2];
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends), 0);
    const pid_t other = ::fork();
    if (other == 0) {
      std::map<std::size_t, std::string> outcomes;
      SocketMessages messages(rank, {{0, ends[1]}});
      if (rank == 1) serve_rank({}, calls_of(outcomes), "this study", messages);
      if (rank == 2) end_without_study(messages);
      ::_exit(0);
    }
    ::close(ends[1]);
    sockets[rank] = ends[0];
    others.push_back(other);
  }
  SocketMessages messages(0, sockets);
  end_without_study(messages);
  for (const pid_t other : others) {
    int status = -1;
    ::waitpid(other, &status, 0);
    EXPECT_EQ(status, 0);
  }
  for (const auto& [rank, socket] : sockets) ::close(socket);
}

TEST(Ranks, AreNoneWithoutAJob) {
  EXPECT_EQ(messages_of_job(std::nullopt), nullptr);
}

}  // namespace
}  // namespace zwang::study
