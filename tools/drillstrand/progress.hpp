/// Progress of a run on the error stream: a bar on a terminal, a line every ten seconds elsewhere.
#pragma once

#include <chrono>

namespace drillstrand::program {

class Progress {
  public:
    /// `duration` is the simulated time of the whole run, of which `begin` is behind it (s).
    Progress(double begin, double duration, bool quiet);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// The run has come to `time` (simulated s). Cheap: prints only when it is time to.
    void update(double time);
    /// Takes the bar away, so that other lines can follow.
    void clear();
    [[nodiscard]] double wall_seconds() const;

  private:
    using Clock = std::chrono::steady_clock;

    struct Mark {
        Clock::time_point wall;
        double time = 0;
    };

    void print(double time);
    [[nodiscard]] double rate(const Mark& now) const;

    double duration_;
    bool quiet_;
    bool terminal_;
    bool bar_shown_ = false;
    Clock::time_point start_ = Clock::now();
    Clock::time_point next_print_;
    /// The rate is taken over the last ten to twenty seconds: from the older mark.
    Mark older_;
    Mark newer_;
};

}  // namespace drillstrand::program
