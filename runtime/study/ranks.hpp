/// One study on many machines: rank 0 hands out cells, keeps what comes back, and runs cells itself.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "study/workers.hpp"

namespace zwang::study {

/// The messages between the processes of a job. The texts of each process arrive whole, and in order.
class Messages {
 public:
  struct Message {
    int from = 0;  ///< rank
    std::string text;
  };
  virtual ~Messages() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  virtual void send(int to, const std::string& text) = 0;
  /// The next one; nothing where none comes within so long. [s]
  virtual std::optional<Message> receive(double most) = 0;
};

/// The processes that `mpirun` or `srun` started together with this one; nullptr where neither did. `library`
/// speaks MPI. Throws std::runtime_error where one of them did and there is no library, or it cannot be
/// loaded.
std::unique_ptr<Messages> messages_of_job(const std::optional<std::filesystem::path>& library);

/// Rank 0: as `run_all`, with the processes of this machine and all other ranks. `identity` is that of the
/// study and the program. Throws std::runtime_error where another rank has read another study.
void run_with_ranks(const std::vector<std::size_t>& cells, const WorkSettings& settings,
                    const WorkCalls& calls, const std::string& identity, Messages& messages);

/// Every other rank: runs the cells that rank 0 sends until it sends no more.
void serve_rank(const WorkSettings& settings, const WorkCalls& calls, const std::string& identity,
                Messages& messages);

/// Rank 0 or another one that could not read the study: the job ends, without a cell.
void end_without_study(Messages& messages);

}  // namespace zwang::study
