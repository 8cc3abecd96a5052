#include "netsim/demo/setup_picture.h"

#include "netsim/demo/run_numbers.h"
#include "netsim/plot/ticks.h"

namespace tandem::netsim::demo {
namespace {

/// Returns the drawing of one client: a hand on a device, centred at `x`.
std::string workstation(double x, const std::string& name, const std::string& ink) {
  const auto at = [&](double dx) { return plot::number_text(x + dx, 0); };
  return "<rect class=\"box\" x=\"" + at(-85) +
         "\" y=\"6\" width=\"170\" height=\"74\" rx=\"8\"/><text class=\"mid title\" x=\"" + at(0) + "\" y=\"26\">" +
         name + "</text><path class=\"line " + ink + "\" d=\"M" + at(-62) + " 66h44M" + at(-40) + " 66V48L" + at(-6) +
         " 38l26 16\"/><circle class=\"tip " + ink + "\" cx=\"" + at(20) + "\" cy=\"54\" r=\"6\"/><text x=\"" + at(30) +
         "\" y=\"50\">hand</text><text class=\"tick\" x=\"" + at(-8) + "\" y=\"73\">simulated Touch</text>";
}

}  // namespace

std::string setup_picture(bool real_time) {
  const auto ms = [](double value) { return plot::number_text(value, 0) + " ms"; };
  const std::string impairment = ms(kBadDelayMs) + " + 0–" + ms(kBadJitterMs) + " jitter, " +
                                 plot::number_text(kBadLossPercent, 0) + " % lost each way";
  return "<svg class=\"figure setup\" viewBox=\"0 0 390 330\" role=\"img\" "
         "xmlns=\"http://www.w3.org/2000/svg\"><title>A "
         "trainer and a trainee, each with a haptic device, are coupled through a network and a server to one tool "
         "that "
         "touches a wall</title>" +
         workstation(95, "trainer", "trainer") + workstation(295, "trainee", "trainee") +
         "<path class=\"line wire\" d=\"M95 80v32M295 80v32M95 176v24M295 176v24\"/>"
         "<rect class=\"box cloud\" x=\"10\" y=\"112\" width=\"370\" height=\"64\" rx=\"26\"/>"
         "<text class=\"mid title\" x=\"195\" y=\"135\">network simulator</text><text class=\"mid tick\" x=\"195\" "
         "y=\"151\">none added, or the bad network:</text><text class=\"mid tick\" x=\"195\" y=\"167\">" +
         impairment +
         "</text><rect class=\"box\" x=\"10\" y=\"200\" width=\"370\" height=\"124\" rx=\"8\"/><text class=\"mid "
         "title\" "
         "x=\"195\" y=\"220\">server: shares authority α, sends forces back</text>"
         "<path class=\"line slave\" d=\"M70 296V262L130 244L200 268\"/><rect class=\"tip slave\" x=\"192\" y=\"260\" "
         "width=\"16\" height=\"16\"/><text class=\"mid\" x=\"120\" y=\"314\">the tool that both hands hold</text>"
         "<rect class=\"wall\" x=\"290\" y=\"232\" width=\"76\" height=\"84\"/><text class=\"mid\" x=\"328\" "
         "y=\"278\">wall</text><text class=\"tick end\" x=\"284\" y=\"252\">contact runs only</text>" +
         (real_time ? "" : "<text class=\"tick\" x=\"20\" y=\"236\">virtual time, one process</text>") + "</svg>\n";
}

}  // namespace tandem::netsim::demo
