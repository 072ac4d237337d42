// The processes of an MPI job. The one file that knows MPI: a library that `zwang sweep` loads under mpirun
// or srun alone.
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "study/ranks.hpp"

namespace zwang::study {

namespace {

using Clock = std::chrono::steady_clock;

/// Messages of cells that take no time follow each other within microseconds. Where none comes, the rank asks
/// ever more rarely: cells of a run take 0.1 s and more, and asking each 50 us took a fifth of their core.
constexpr std::chrono::microseconds shortest_nap{50}, longest_nap{1000};

class MpiMessages : public Messages {
 public:
  MpiMessages() {
    // Cells run in processes of their own, which never speak MPI.
    ::setenv("OMPI_MCA_mpi_warn_on_fork", "0", 0);
    int given = 0;
    if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given) != MPI_SUCCESS)
      throw std::runtime_error("MPI does not start");
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    uncaught_ = std::uncaught_exceptions();
  }
  ~MpiMessages() override {
    // The others wait for this rank: where it fails, the job does.
    if (std::uncaught_exceptions() > uncaught_) MPI_Abort(MPI_COMM_WORLD, EXIT_FAILURE);
    MPI_Finalize();
  }
  MpiMessages(const MpiMessages&) = delete;
  MpiMessages& operator=(const MpiMessages&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }
  void send(int to, const std::string& text) override {
    MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, to, 0, MPI_COMM_WORLD);
  }
  std::optional<Message> receive(double most) override {
    const auto end = Clock::now() + std::chrono::duration<double>(most);
    for (;;) {
      int is_there = 0, size = 0;
      MPI_Status status;
      MPI_Iprobe(MPI_ANY_SOURCE, 0, MPI_COMM_WORLD, &is_there, &status);
      if (is_there != 0) {
        nap_ = shortest_nap;
        MPI_Get_count(&status, MPI_CHAR, &size);
        Message message{status.MPI_SOURCE, std::string(static_cast<std::size_t>(size), '\0')};
        MPI_Recv(message.text.data(), size, MPI_CHAR, status.MPI_SOURCE, 0, MPI_COMM_WORLD,
                 MPI_STATUS_IGNORE);
        return message;
      }
      if (Clock::now() >= end) return std::nullopt;
      std::this_thread::sleep_for(nap_);
      nap_ = std::min(2 * nap_, longest_nap);
    }
  }

 private:
  std::chrono::microseconds nap_ = shortest_nap;
  int rank_ = 0, size_ = 1;
  int uncaught_ = 0;
};

}  // namespace

}  // namespace zwang::study

/// By this name `messages_of_job` finds it.
extern "C" zwang::study::Messages* zwang_join_job() {
  return new zwang::study::MpiMessages;
}
