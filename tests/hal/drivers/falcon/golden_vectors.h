#pragma once

#include <Eigen/Core>
#include <array>

/// Golden vectors of an independent host of the Falcon: libnifalcon/libnifalcon f7c727a,
/// src/kinematic/FalconKinematicStamper.cpp with include/falcon/core/FalconGeometry.h.
/// It shares no code and no constant with this project. Made 2026-11-22.
///   Frame: libnifalcon's, x to the right, y up, z out of the device towards the user, origin in its base.
///   Position: getPosition(counts), repeated on its own result until its IK() gives these counts to 1e-6 rad (one call
///     stops at 0.01 rad).
///   Motors: libnifalcon's IK() differentiated numerically, with its factor of 10000 counts per N m and its sign
///     (enc_force = -torque). Its jacobian() and its transposition in place have wrong magnitudes (the axial torque is
///     1.25 to 1.32 times too high). The signs of all of its own motor values were compared with those below and agree.
namespace tandem::test {

struct GoldenLegs {
  std::array<int, 3> counts;  ///< encoder counts of the legs, homed
  Eigen::Vector3d tip;        ///< [m]
  /// Motor values for forces of 1 N at the grip along x, y, z, and for kGoldenFalconMixed.
  std::array<Eigen::Vector3d, 4> motors;
};

inline const Eigen::Vector3d kGoldenFalconMixed{0.6, -0.5, 0.8};  ///< [N]

inline const std::array<GoldenLegs, 7> kGoldenFalcon{{
    {{0, 0, 0},
     {0.0000000, 0.0000000, 0.1346024},
     {{{-193.17, 650.90, -457.73},
       {639.83, -152.69, -487.14},
       {-249.46, -249.27, -249.41},
       {-635.39, 267.47, -230.60}}}},
    {{150, 0, 0},
     {0.0018907, -0.0062746, 0.1367741},
     {{{-203.33, 644.79, -451.27},
       {675.30, -155.77, -489.56},
       {-205.09, -267.75, -268.00},
       {-623.72, 250.56, -240.38}}}},
    {{0, 150, 0},
     {-0.0063793, 0.0014999, 0.1367741},
     {{{-198.11, 686.54, -457.51},
       {635.99, -161.65, -480.59},
       {-268.02, -204.93, -267.89},
       {-651.28, 328.81, -248.52}}}},
    {{0, 0, 150},
     {0.0044886, 0.0047747, 0.1367741},
     {{{-187.37, 649.37, -482.90},
       {636.65, -146.33, -513.83},
       {-268.01, -267.92, -204.97},
       {-645.16, 248.46, -196.80}}}},
    {{-300, 100, 250},
     {0.0000378, 0.0203284, 0.1334379},
     {{{-167.89, 679.06, -513.27},
       {555.76, -137.16, -513.44},
       {-359.40, -221.89, -151.53},
       {-666.13, 298.50, -172.47}}}},
    {{400, 350, -200},
     {-0.0149743, -0.0192734, 0.1404034},
     {{{-260.86, 707.60, -401.39},
       {719.18, -208.04, -437.02},
       {-148.59, -178.80, -379.50},
       {-634.97, 385.54, -325.92}}}},
    {{-200, -250, -300},
     {-0.0007550, -0.0032767, 0.1225442},
     {{{-178.97, 593.43, -410.13},
       {596.89, -140.61, -435.20},
       {-234.44, -252.19, -268.79},
       {-593.38, 224.61, -243.51}}}},
}};

}  // namespace tandem::test
