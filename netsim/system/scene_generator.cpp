#include "netsim/system/scene_generator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "common/base/format.h"
#include "netsim/system/random_draws.h"

namespace tandem::netsim {

namespace {

class SceneGenerator {
 public:
  SceneGenerator(RandomKey key, double duration_s, LawKind law)
      : draws_(key),
        replica_draws_(key.derive(kReplicaDraws)),
        assist_draws_(key.derive(kAssistDraws)),
        key_draws_(key.derive(kKeyDraws)),
        replica_(law == LawKind::kReplica),
        duration_s_(duration_s) {}

  std::string text() {
    draw_size();
    header();
    for (std::size_t i = 0; i < masters_; ++i) seat(i);
    for (std::size_t j = 0; j < tools_; ++j) tool(j);
    for (std::size_t j = 0; j < tools_; ++j) out_ += weights(j) + "\n";
    for (std::size_t i = 0; replica_ && tools_ > 1 && i < masters_; ++i) follow(i);
    timeline();
    numerics();
    send();
    return std::move(out_);
  }

 private:
  void draw_size() {
    axes_ = draws_.chance(0.3) ? 1 : 3;
    masters_ = 1 + draws_.choose(std::array{0.20, 0.36, 0.18, 0.10, 0.06, 0.04, 0.03, 0.03});
    tools_ = std::min(masters_, 1 + draws_.choose(std::array{0.70, 0.18, 0.07, 0.05}));
    // Seats that may lead come first; every tool gets one of them.
    leaders_ = tools_ + (masters_ > tools_ ? draws_.below(masters_ - tools_ + 1) : 0);
    tick_hz_ = std::array{1000.0, 500.0, 2000.0}[draws_.choose(std::array{0.85, 0.1, 0.05})];
    damping_ = draws_.chance(0.7) ? 0.2 : draws_.between(0.2, 2);
  }

  void header() {
    const double limit = std::min(400.0, 2 * 0.2 * tick_hz_);
    joints_ = axes_ == 3 && draws_.chance(0.25) && !replica_;
    out_ += format("version: 1  tick_hz: %g  dof: %zu  duration_s: %g  port: %s  ", tick_hz_, axes_, duration_s_,
                   joints_ ? "JOINT" : "TIP");
    out_ += draws_.chance(0.1)
                ? "alpha_step: true\n"
                : format("alpha_slew_per_s: %.3g\n", draws_.chance(0.5) ? 1.0 : draws_.log_between(0.1, 100));
    const char* const mfs =
        std::array{"OPEN", "TANK", "SEED", "SEED_SIGNED"}[draws_.choose(std::array{0.7, 0.1, 0.1, 0.1})];
    const bool seeds = mfs[0] == 'S';  // these sources cut a velocity, which law REPLICA does not send
    exact_ = seeds && !replica_;
    out_ +=
        format("channel { law: %s mfs: %s", replica_ ? "REPLICA" : "SET_POSITION", replica_ && seeds ? "OPEN" : mfs);
    if (draws_.chance(0.4)) out_ += format(" k_n_m: %.4g", draws_.log_between(100, 3000));
    const double force_max = draws_.chance(0.6) ? 3.3 : draws_.between(0.5, 6);
    constexpr double kMin =
        60;  // a smaller initial energy than the full pull of the softest spring would dead-lock a start
    if (draws_.chance(0.5)) {
      const double written = std::strtod(format("%.3g", force_max).c_str(), nullptr);  // as printed, perhaps rounded up
      const double drawn = 1.001 * force_max * force_max / (2 * kMin) * draws_.log_between(1, 5);
      out_ += format(" e0_j: %.4g", std::max(drawn, 1.001 * written * written / (2 * kMin)));
    }
    if (draws_.chance(0.3)) out_ += format(" eta: %.3g", draws_.between(0, 1));
    if (draws_.chance(0.3)) out_ += format(" margin_max_j: %.3g", draws_.log_between(0.005, 1));
    if (draws_.chance(0.3)) out_ += format(" v_app_m_s: %.3g", draws_.log_between(0.02, 0.5));
    if (draws_.chance(0.2)) out_ += " effort_half: false";
    if (draws_.chance(0.3)) out_ += format(" lead_max_ms: %.3g", draws_.between(0, 100));
    out_ +=
        format(" }\ndevice_coupling { k_c_n_m: %.4g b_n_s_m: %.3g m_c_kg: %.3g }\n",
               draws_.chance(0.6) ? limit : draws_.between(50, limit), draws_.chance(0.7) ? 0.5 : draws_.between(0, 2),
               draws_.chance(0.7) ? 0.02 : draws_.log_between(0.005, 0.2));
    silence_ms_ = draws_.chance(0.6) ? 20.0 : draws_.between(10, 100);
    out_ += format(
        "gate { silence_limit_ms: %.3g loop_age_max_ms: %.5g latch: %s ramp_in_ms: %.4g force_max_n: %.3g }\n",
        silence_ms_, draws_.chance(0.5) ? 2500.0 : draws_.between(300, 2500), draws_.chance(0.3) ? "true" : "false",
        draws_.chance(0.6) ? 500.0 : draws_.log_between(50, 1500), force_max);
  }

  std::string device() {
    std::string text = format("damping_n_s_m: %.4g", damping_);
    if (draws_.chance(0.5)) text += format(" friction_n: %.3g", draws_.between(0, 0.3));
    if (draws_.chance(0.3)) text += " friction_feedforward: true";
    if (axes_ == 3 && draws_.chance(0.2)) text += " gravity_compensation: false";
    if (axes_ == 1 && draws_.chance(0.5)) text += format(" mass_kg: %.3g", draws_.log_between(0.05, 0.5));
    if (draws_.chance(0.3))
      text += format(" start_m { x: %.3g%s }", draws_.between(-0.02, 0.02),
                     axes_ == 3 ? format(" z: %.3g", draws_.between(-0.02, 0.02)).c_str() : "");
    return text;
  }

  std::string hand() {
    constexpr std::array kModels{"LEADER", "RELAXED", "RESTING", "LETTING_GO", "TREMOR", "NONE"};
    const std::size_t model = draws_.choose(std::array{0.4, 0.25, 0.12, 0.1, 0.08, 0.05});
    std::string text = format("hand { model: %s", kModels[model]);
    if (model == 0 || model == 3 || model == 4) {
      if (draws_.chance(0.6)) {
        text += format(" trajectory { circle { radius_m: %.3g frequency_hz: %.3g } }", draws_.between(0.005, 0.05),
                       draws_.log_between(0.1, 2));
      } else {
        text += " trajectory {";
        double at = 0.2;
        for (std::size_t n = 2 + draws_.below(8); n > 0; --n, at += draws_.between(0.2, 3))
          text += format(" waypoint { at_s: %.3f x_m: %.4f }", at, draws_.between(-0.04, 0.04));
        text += " }";
      }
      if (model == 3) text += format(" release_at_s: %.3g", draws_.between(0.5, 20));
      if (draws_.chance(0.3)) text += format(" from_s: %.3g", draws_.between(0, 5));
    }
    double at = draws_.between(0, 5);
    for (std::size_t n = draws_.chance(0.4) ? 1 + draws_.below(4) : 0; n > 0; --n, at += draws_.between(1, 6))
      text += format(" deviation { at_s: %.3f for_s: %.3g force_n { x: %.3g } }", at, draws_.between(0.05, 2),
                     draws_.between(-5, 5));
    return text + " }";
  }

  std::string environment() {
    const std::size_t kind = draws_.choose(std::array{0.4, 0.35, 0.25});
    if (kind == 0) return {};
    const char* const axis = axes_ == 3 && draws_.chance(0.4) ? "Z" : "X";
    const double at = draws_.between(-0.01, 0.03);
    if (kind == 1)
      return format("environment { wall { axis: %s at_m: %.3g k_n_m: %.4g } }", axis, at,
                    draws_.log_between(300, 20000));
    return format("environment { tissue { axis: %s at_m: %.3g k_n_m: %.4g from_below: true } }", axis, at,
                  draws_.log_between(50, 1000));
  }

  void seat(std::size_t i) {
    const char* const role = i == 0               ? "INSTRUCTOR"
                             : i < leaders_       ? "TRAINEE"
                             : draws_.chance(0.7) ? "EVALUATOR"
                                                  : "OBSERVER";
    out_ += format("seat { name: \"seat%zu\" kind: MASTER role: %s required: %s", i, role,
                   i < tools_ || draws_.chance(0.7) ? "true" : "false");
    const bool separates = !joints_ && key_draws_.chance(kSeparates);
    out_ += " device { " + device() + (separates ? " calibrate: true" : "") + " } " + hand();
    if (separates) out_ += " force_separation: true";
    if (!joints_ && key_draws_.chance(kScaled)) out_ += format(" motion_scale: %.3g", key_draws_.log_between(0.4, 2.5));
    if (replica_ && assist_draws_.chance(kAssisted))
      out_ += format(" assist { force_n: %.3g in_contact: %s }", assist_draws_.between(0, 3),
                     assist_draws_.chance(0.5) ? "true" : "false");
    out_ += " }\n";
  }

  void tool(std::size_t j) {
    const std::string ipc = format("k_s_n_m: %.4g m_s_kg: %.3g", std::min(400.0, 2 * 0.2 * tick_hz_),
                                   draws_.chance(0.7) ? 0.05 : draws_.log_between(0.02, 0.3));
    if (draws_.chance(0.2)) {
      steppable_ = steppable_ && replica_;
      out_ += format("tool { name: \"tool%zu\" %s }\n", j, ipc.c_str());
      out_ += format("seat { name: \"slave%zu\" kind: SLAVE tool: \"tool%zu\" required: true", j, j);
      out_ += " device { " + device() + " } " + environment() + " }\n";
      return;
    }
    const std::string slave = device(), surfaces = environment();
    if (replica_ && replica_draws_.chance(kVirtual)) {
      const double mass = replica_draws_.log_between(0.005, 0.1);
      out_ +=
          format("tool { name: \"tool%zu\" m_s_kg: %.3g slave { model: VIRTUAL %s } }\n", j, mass, surfaces.c_str());
    } else {
      steppable_ = false;
      out_ +=
          format("tool { name: \"tool%zu\" %s slave { model: %s ", j, ipc.c_str(), axes_ == 1 ? "LINEAR" : "TOUCH") +
          slave + " " + surfaces + " } }\n";
    }
  }

  /// Couples half of the hands to several tools; the shares sum to 1 exactly as printed.
  void follow(std::size_t seat) {
    if (replica_draws_.chance(0.5)) return;
    int left = 1000;
    for (std::size_t j = 0; j < tools_ && left > 0; ++j) {
      const int share =
          j + 1 == tools_ ? left : static_cast<int>(replica_draws_.below(static_cast<std::uint64_t>(left) + 1));
      if (share > 0)
        out_ += format("follow { seat: \"seat%zu\" tool: \"tool%zu\" weight: %.3f }\n", seat, j, share / 1000.0);
      left -= share;
    }
  }

  /// Returns a row of authority over one tool that sums to 1 exactly as printed: thousandths, the last takes the rest.
  std::string weights(std::size_t tool) {
    std::vector<int> share(leaders_, 0);
    if (draws_.chance(0.4)) {
      share[tool < leaders_ ? tool : 0] = 1000;
    } else {
      int left = 1000;
      for (std::size_t i = 0; i + 1 < leaders_; ++i)
        left -= share[i] = static_cast<int>(draws_.below(static_cast<std::uint64_t>(left) + 1));
      share[leaders_ - 1] = left;
    }
    std::string text;
    for (std::size_t i = 0; i < leaders_; ++i)
      if (share[i] > 0)
        text += format("authority { tool: \"tool%zu\" seat: \"seat%zu\" alpha: %g } ", tool, i, share[i] / 1000.0);
    return text;
  }

  void timeline() {
    double at = draws_.between(0.2, 4);
    for (std::size_t n = draws_.below(12); n > 0 && at < duration_s_; --n, at += draws_.log_between(0.05, 6))
      out_ += format("timeline { at_s: %.4f ", at) + weights(draws_.below(tools_)) + "}\n";
  }

  /// Steps of the simulated tools that keep the proof of passivity; a device moves no tool of such a scene.
  void numerics() {
    if (steppable_ && key_draws_.chance(kStepped))
      out_ += format("numerics { substeps: %zu }\n", 2 + key_draws_.below(7));
  }

  /// Datagrams that both ends hold back.
  void send() {
    // A sixth of the shortest silence that is tolerated, of the value as printed.
    const double heartbeat_ms = (replica_ ? 100 : 0.999 * std::min(100.0, silence_ms_) - 0.05) / 6;
    if (joints_ || exact_ || heartbeat_ms * tick_hz_ < 1000 || !key_draws_.chance(kHoldsBack)) return;
    out_ += format("send { prediction_order: %d", key_draws_.chance(0.3) ? 0 : 1);
    double chosen_ms = heartbeat_ms;
    if (key_draws_.chance(0.3)) {
      chosen_ms = std::max(1001 / tick_hz_, heartbeat_ms * key_draws_.between(0.3, 0.99));
      out_ += format(" heartbeat_ms: %.5g", chosen_ms);
    }
    const double rate_min =
        1.001 * tick_hz_ / std::floor(chosen_ms * 1e-3 * tick_hz_ + 1e-9);  // [Hz], one per heartbeat
    const bool rated = rate_min < tick_hz_ && key_draws_.chance(0.3);
    if (rated) out_ += format(" rate_hz: %.6g", key_draws_.between(rate_min, tick_hz_));
    if (!rated || key_draws_.chance(0.5))
      out_ += format(" dead_band { weber: %.3g }", key_draws_.log_between(0.01, 0.4));
    out_ += " }\n";
  }

  static constexpr std::uint64_t kReplicaDraws = 0x72, kAssistDraws = 0x61, kKeyDraws = 0x6b;
  static constexpr double kVirtual = 0.75;  ///< share of the tools that the server simulates
  static constexpr double kAssisted = 0.4;  ///< share of the hands with assistance
  /// Shares of the hands with a scale and with force separation, and of the scenes with substeps and held datagrams.
  static constexpr double kScaled = 0.2, kSeparates = 0.1, kStepped = 0.3, kHoldsBack = 0.3;

  RandomDraws draws_;
  RandomDraws replica_draws_, assist_draws_,
      key_draws_;  ///< separate, so that a seed draws the same seats, tools and motions for every law
  bool replica_;
  double duration_s_;
  std::size_t axes_ = 3, masters_ = 1, tools_ = 1, leaders_ = 1;
  double tick_hz_ = 1000, damping_ = 0.2, silence_ms_ = 20;
  bool joints_ = false, exact_ = false;
  bool steppable_ = true;  ///< no device moves a tool
  std::string out_;
};

}  // namespace

std::string generate_scene_text(RandomKey key, double duration_s, LawKind law) {
  return SceneGenerator(key, duration_s, law).text();
}

}  // namespace tandem::netsim
