#include "netsim/demo/animation.h"

#include <algorithm>
#include <cmath>

#include "netsim/demo/animation_script.h"

namespace tandem::netsim::demo {
namespace {

constexpr double kTenthMm = 1e4, kHundredthN = 100, kPercent = 100;
constexpr double kCoordinateLimit = 1e6;  ///< limit of a drawn value, so that invalid data stays a number

void put(std::array<int, MotionFrames::kValues>& frame, std::size_t& at, double value, double scale) {
  const double scaled = value * scale;
  if (std::isfinite(scaled))
    frame[at] = static_cast<int>(std::lround(std::clamp(scaled, -kCoordinateLimit, kCoordinateLimit)));
  ++at;
}

std::string frames_text(const MotionFrames& motion) {
  std::string text = "[";
  for (const auto& frame : motion.frames)
    for (const int value : frame) text += (text.size() > 1 ? "," : "") + std::to_string(value);
  return text + "]";
}

}  // namespace

MotionFrames motion_frames(const TraceData& trace) {
  MotionFrames motion;
  if (trace.rows() == 0) return motion;
  std::array<int, MotionFrames::kValues> frame{};
  double next = 0;
  for (std::size_t k = 0; k < trace.rows(); ++k) {
    if (trace.t[k] < next - 1e-9) continue;
    std::size_t at = 0;
    for (const Column3* x : {&trace.trainer.x, &trace.trainee.x, &trace.tool.x})
      for (std::size_t a = 0; a < 3; ++a) put(frame, at, (*x)[a][k], kTenthMm);
    for (const SeatTrace* seat : {&trace.trainer, &trace.trainee})
      put(frame, at, std::hypot(seat->f_out[0][k], seat->f_out[1][k], seat->f_out[2][k]), kHundredthN);
    put(frame, at, trace.trainer.alpha[k], kPercent);
    // A gap in the trace repeats the frame, so that the time axis stays correct.
    for (; next <= trace.t[k] + 1e-9; next += 1 / MotionFrames::kRate) motion.frames.push_back(frame);
  }
  return motion;
}

std::string animation_html(std::span<const RunResult> runs) {
  std::string options, data;
  for (const RunResult& run : runs) {
    if (run.motion.frames.empty()) continue;
    const bool contact = run.plan->task == Task::kContact;
    options +=
        "<option value=\"" + std::string(run.plan->name) + "\">" + plot::escaped(title_of(*run.plan)) + "</option>";
    data += (data.empty() ? "" : ",\n") + ("\"" + std::string(run.plan->name)) +
            "\":{\"wall\":" + (contact ? "true" : "false") + ",\"frames\":" + frames_text(run.motion) + "}";
  }
  if (data.empty()) return "";
  return "<h2 id=\"motion\">Watch it</h2>\n<p class=\"soft\">Circles are the tips of the hands, the square is the "
         "tool. Lines are the last two seconds. Drag the slider, or press Play.</p>\n"
         "<noscript><p>This animation needs the script in this page. Everything else is drawn without "
         "it.</p></noscript>\n"
         "<div class=\"player\"><p><label>Run <select id=\"player-run\">" +
         options +
         "</select></label> <button id=\"player-play\" type=\"button\">Play</button></p>\n"
         "<canvas id=\"player-view\" role=\"img\" aria-label=\"Tips of both hands and of the tool, from the front and "
         "from above\"></canvas>\n"
         "<input id=\"player-time\" type=\"range\" min=\"0\" value=\"0\" aria-label=\"session time\">\n"
         "<p id=\"player-text\" class=\"soft\"></p></div>\n<script>\nconst kRate = " +
         std::to_string(static_cast<int>(MotionFrames::kRate)) +
         ", kValues = " + std::to_string(MotionFrames::kValues) + ";\nconst kRuns = {" + data + "};\n" +
         std::string(kAnimationScript) + "</script>\n";
}

}  // namespace tandem::netsim::demo
