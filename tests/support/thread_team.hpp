#pragma once
/// \file
/// A team of threads in the place of one of processes.

#include <treeform/mesh/mesh_file.hpp>
#include <treeform/tf.hpp>

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace test {

struct killed : std::runtime_error {
    killed() : std::runtime_error("killed") {}
};

/// Where one is killed, none goes on.
class thread_team {
  public:
    explicit thread_team(std::size_t size) : mine_(size) {}

    [[nodiscard]] tf::communicator as(std::size_t rank) {
        return {rank, mine_.size(),
                [this, rank](const std::string& told) { return exchange(rank, told); }};
    }
    void kill() {
        const std::lock_guard lock(mutex_);
        broken_ = true;
        changed_.notify_all();
    }

  private:
    std::vector<std::string> exchange(std::size_t rank, const std::string& told) {
        std::unique_lock lock(mutex_);
        const std::size_t round = round_;
        mine_[rank] = told;
        if (++here_ == mine_.size()) {
            here_ = 0;
            ++round_;
            all_ = mine_;
            changed_.notify_all();
        }
        changed_.wait(lock, [&] { return broken_ || round_ != round; });
        if (round_ == round) throw killed();
        return all_;
    }

    std::mutex mutex_{};
    std::condition_variable changed_{};
    std::vector<std::string> mine_;
    std::vector<std::string> all_{};
    std::size_t here_ = 0;
    std::size_t round_ = 0;
    bool broken_ = false;
};

/// Each does `work(team)`. Returns false where one was `killed`; what else one throws is thrown.
template <class Work>
bool run_as_team(std::size_t size, const Work& work) {
    thread_team all(size);
    std::vector<std::exception_ptr> thrown(size);
    std::vector<std::thread> threads;
    for (std::size_t rank = 0; rank < size; ++rank)
        threads.emplace_back([&, rank] {
            try {
                work(all.as(rank));
            } catch (...) {
                thrown[rank] = std::current_exception();
                all.kill();
            }
        });
    for (std::thread& t : threads) t.join();
    bool all_lived = true;
    for (const std::exception_ptr& error : thrown) try {
            if (error) std::rethrow_exception(error);
        } catch (const killed&) {
            all_lived = false;
        }
    return all_lived;
}

}  // namespace test
