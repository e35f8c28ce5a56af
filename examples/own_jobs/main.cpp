// A world on the threads of an engine's own pool, in place of divot's.
#include <divot/divot.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <iostream>
#include <mutex>
#include <thread>
#include <vector>

namespace {

// A pool as engines have them: threads that wait for a piece of work, which all of them share.
class Pool {
 public:
  explicit Pool(unsigned threads) {
    for (unsigned k = 1; k < threads; ++k) threads_.emplace_back([this] { serve(); });
  }
  ~Pool() {
    {
      const std::lock_guard lock(mutex_);
      over_ = true;
    }
    wake_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

  // Calls `work` on ranges of `grain` that cover [0, count); the caller helps. Returns when all are done.
  void run(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& work) {
    const Piece piece{count, grain, &work};
    {
      const std::lock_guard lock(mutex_);
      piece_ = piece, next_ = 0, busy_ = threads_.size(), ++round_;
    }
    wake_.notify_all();
    take_ranges(piece);
    std::unique_lock lock(mutex_);
    done_.wait(lock, [&] { return busy_ == 0; });
    ++runs_;
  }
  std::size_t runs() const { return runs_; }

 private:
  struct Piece {
    std::size_t count = 0, grain = 1;
    const std::function<void(std::size_t, std::size_t)>* work = nullptr;
  };
  void take_ranges(const Piece& piece) {
    for (std::size_t begin; (begin = next_.fetch_add(piece.grain)) < piece.count;)
      (*piece.work)(begin, std::min(begin + piece.grain, piece.count));
  }
  void serve() {
    std::uint64_t seen = 0;
    for (std::unique_lock lock(mutex_);;) {
      wake_.wait(lock, [&] { return over_ || round_ != seen; });
      if (over_) return;
      seen = round_;
      const Piece piece = piece_;
      lock.unlock();
      take_ranges(piece);
      lock.lock();
      if (--busy_ == 0) done_.notify_one();
    }
  }

  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable wake_, done_;
  Piece piece_;
  std::atomic<std::size_t> next_ = 0;
  std::size_t busy_ = 0, runs_ = 0;
  std::uint64_t round_ = 0;
  bool over_ = false;
};

std::uint64_t hash_of(std::shared_ptr<const divot::Jobs> jobs) {
  divot::Scene scene;
  scene.terrain = {.shape = divot::GridTerrain{.columns = 151, .rows = 151, .spacing = 0.1}, .material = "dry_sand"};
  scene.bombs = {{.time = 0, .yield = 0.004}};
  auto world = divot::World::create(scene, std::move(jobs));
  while (world && world->time() < 1) world->step();
  return world ? world->state_hash() : 0;
}

}  // namespace

int main() {
  Pool pool(3);
  const divot::Jobs::Runner runner = [&pool](std::size_t count, std::size_t grain, const auto& work) {
    pool.run(count, grain, work);
  };
  const std::uint64_t mine = hash_of(std::make_shared<const divot::Jobs>(3, runner));
  const std::uint64_t one = hash_of(std::make_shared<const divot::Jobs>(1));
  std::cout << "The pool ran " << pool.runs() << " pieces; its bits " << (mine == one ? "are" : "are NOT")
            << " those of one thread.\n";
  return mine == one && pool.runs() > 0 ? 0 : 1;
}
