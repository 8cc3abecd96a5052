#pragma once

/// Footnotes of the comparison: how a number is measured, and which disturbances the model lacks where it is better
/// than expected.
namespace tandem::netsim::demo::notes {

inline constexpr const char* kDistance =
    "RMS of |hand tip − tip of the tool| in space; the tool is the paper’s slave. Not counted: the pushes a and b (1.5 "
    "s each) and the first second.";
inline constexpr const char* kDelayed =
    "On the bad network the limit is 1.25 × (our RMS without delay + the transport lag of that motion): as asked at 20 "
    "ms one way, here with jitter and loss on top.";
inline constexpr const char* kJoints =
    "The paper gives joints for t < 5 s, we for the whole phase. Its trajectory is not published; ours is a circle of "
    "5 cm at 0.5 Hz. ≤ 10 is the design’s own goal. The defaults’ tool is no robot and has no joints.";
inline constexpr const char* kAlphaStep =
    "The paper: “a small sudden change”, “hardly perceived”. Commanded force on either hand, 1 ms apart.";
inline constexpr const char* kStiffness =
    "Δforce/Δx of the leader, from the trace: least squares of the commanded force along x over x(leader) − x(tool), "
    "less the dampers’ share (a term with the speed), while the leader presses up to 15 mm deep.";
inline constexpr const char* kHeld =
    "The paper’s own division, 10 N / 4 cm. With joint springs and without gravity compensation the arms sag and leave "
    "the working pose while they press, which softens what is felt along x.";
inline constexpr const char* kAlongX =
    "Along x as in the paper; leader 5–20 s, follower from 13 s. Seed: commanded force, since no Touch gives 10 N; "
    "defaults: force delivered at the hand against the force of the block on the tool, while both hold still; "
    "while the leader moves into the block the two differ by up to 0.02 N.";
inline constexpr const char* kAligned =
    "From 13 s. The trainee’s simulated hand follows the scene, not a plot as a person would: this "
    "measures the hand model. ≤ 0.5 is the design’s own goal.";
inline constexpr const char* kApart =
    "In contact a hand is beyond the wall by force / stiffness: a distance, not an error.";
inline constexpr const char* kAllAxes =
    "All three axes: with the seed’s gains and without gravity compensation this contains the weight of the arms, "
    "which "
    "the paper’s number along x does not.";
inline constexpr const char* kMachine =
    "Counted and shown, never a failure: a busy machine makes ticks late, and after a silence a gate releases the hand "
    "softly.";

/// Disturbances that the footnote "the model lacks" names.
inline constexpr const char* kLacksArms =
    "the weight and friction of real arms and the differences between three real devices";
inline constexpr const char* kLacksJoints = "the play, cable stretch and unequal weight of the paper’s real joints";
inline constexpr const char* kLacksMotors = "the unequal motors, gears and force calibrations of three real devices";
inline constexpr const char* kLacksPerson = "a person who aligns by watching a plot; our hand knows the place";

}  // namespace tandem::netsim::demo::notes
