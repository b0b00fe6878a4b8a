// Solves a scene of space with Simbody: simbody_space SCENE METHOD ACCURACY
//
// SCENE: bricard, governor, spatial_slider_crank, ball_pendulum, the decks of the same mechanisms by hand: joint coordinates as Simbody has them,
// loops closed by constraints. METHOD: as simbody_peer. Prints as simbody_peer, with x, y, z of each centre of mass.
#include "simbody_loose.h"

#include <deque>

namespace {

const Real pi = std::acos(Real(-1));

// A mechanism that is put together where its deck puts it: all coordinates begin at zero, unless `start` says otherwise.
struct Mechanism {
   MultibodySystem system;
   SimbodyMatterSubsystem matter{system};
   GeneralForceSubsystem forces{system};
   std::deque<MobilizedBody> bodies;
   std::deque<Transform> poses;
   std::vector<std::unique_ptr<Loose>> loose;
   std::vector<std::pair<int, Real>> start;   // body, first speed
   Real end = 10;

   MobilizedBody& body(int k) { return k < 0 ? static_cast<MobilizedBody&>(matter.Ground()) : bodies[static_cast<size_t>(k)]; }
   Transform pose(int k) const { return k < 0 ? Transform() : poses[static_cast<size_t>(k)]; }
   // A frame of the ground, in a body.
   Transform in(int k, const Transform& frame) const { return (~pose(k))*frame; }
   Vec3 in(int k, const Vec3& point) const { return (~pose(k))*point; }

   static Body::Rigid rigid(Real mass, const Vec3& moments) { return Body::Rigid(MassProperties(mass, Vec3(0), Inertia(moments))); }

   void pin(int parent, const Transform& at, const Vec3& point, const Vec3& axis, const Body& it) {
      const Transform frame(Rotation(UnitVec3(axis), ZAxis), point);
      poses.push_back(at);
      bodies.push_back(MobilizedBody::Pin(body(parent), in(parent, frame), it, (~at)*frame));
   }
   void slide(int parent, const Transform& at, const Vec3& axis, const Body& it) {
      const Transform frame(Rotation(UnitVec3(axis), XAxis), at.p());
      poses.push_back(at);
      bodies.push_back(MobilizedBody::Slider(body(parent), in(parent, frame), it, (~at)*frame));
   }
};

void bricard(Mechanism& it) {
   Force::UniformGravity(it.forces, it.matter, Vec3(0, -9.81, 0));
   const Real across = 0.084167, along = 1.6667e-3;
   const Vec3 joints[] = {{0, 0, 0}, {1, 0, 0}, {1, -1, 0}, {1, -1, 1}, {0, -1, 1}, {0, 0, 1}};
   const Vec3 axes[] = {{0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
   for (int k = 0; k < 5; k++) {
      const Vec3 way = joints[k + 1] - joints[k];
      Vec3 moments(across);
      for (int c = 0; c < 3; c++)
         if (std::abs(way[c]) > 0.5) moments[c] = along;
      it.pin(k - 1, Transform((joints[k] + joints[k + 1])/2), joints[k], axes[k], Mechanism::rigid(1, moments));
   }
   Constraint::Ball(it.body(-1), joints[5], it.body(4), it.in(4, joints[5]));
   for (const CoordinateAxis& axis : {CoordinateAxis(YAxis), CoordinateAxis(ZAxis)})
      Constraint::ConstantAngle(it.body(-1), UnitVec3(axis), it.body(4), UnitVec3(XAxis), pi/2);
}

void governor(Mechanism& it) {
   Force::UniformGravity(it.forces, it.matter, Vec3(0, 0, -9.81));
   const Real reach = 0.97169811320754717, high = 0.47169811320754717;
   it.pin(-1, Transform(Vec3(0, 0, 0.5)), Vec3(0), Vec3(0, 0, 1), Mechanism::rigid(0.3, Vec3(0.0250025, 0.0250025, 5e-6)));
   it.slide(0, Transform(Vec3(0, 0, 0.5)), Vec3(0, 0, 1), Mechanism::rigid(3, Vec3(0.005)));
   for (const Real side : {-1.0, 1.0}) {
      const Vec3 top(0.05*side, 0, 1);
      const Rotation turn((side < 0 ? 150 : 30)*pi/180, YAxis);
      it.pin(0, Transform(turn, top + turn*Vec3(reach, 0, 0)), top, Vec3(0, 1, 0), Mechanism::rigid(5.3, Vec3(5e-6, 0.0957579, 0.0957579)));
      const int rod = static_cast<int>(it.bodies.size()) - 1;
      const Vec3 middle(-high, 0, 0), eye(0.05*side, 0, 0);
      Force::TwoPointLinearSpring(it.forces, it.body(rod), middle, it.body(1), eye, 8e5, 0.5);
      Force::TwoPointLinearDamper(it.forces, it.body(rod), middle, it.body(1), eye, 4e4);
   }
   it.start = {{0, 2*pi}};
}

void slider_crank(Mechanism& it) {
   it.end = 2;
   Force::UniformGravity(it.forces, it.matter, Vec3(0, 0, -9.81));
   const Real x = std::sqrt(0.1275);
   const UnitVec3 along(x, -0.1, -0.15), arm(0.1, x, 0);
   it.pin(-1, Transform(Vec3(0, 0, 0.15)), Vec3(0, 0, 0.15), Vec3(1, 0, 0), Mechanism::rigid(0.2, Vec3(5e-4, 3e-4, 3e-4)));
   const Transform coupler(Rotation(along, XAxis, arm, YAxis), Vec3(x/2, 0.05, 0.075));
   const Vec3 eye(x, 0, 0);
   it.slide(-1, Transform(eye), Vec3(1, 0, 0), Mechanism::rigid(0.5, Vec3(1e-4)));
   const Transform cross(Rotation(UnitVec3(ZAxis), XAxis, arm, YAxis), eye);
   it.poses.push_back(coupler);
   it.bodies.push_back(MobilizedBody::Universal(it.body(1), it.in(1, cross), Mechanism::rigid(0.3, Vec3(2e-5, 4e-3, 4e-3)), (~coupler)*cross));
   const Vec3 pin(0, 0.1, 0.15);
   Constraint::Ball(it.body(0), it.in(0, pin), it.body(2), it.in(2, pin));
}

void ball_pendulum(Mechanism& it) {
   it.end = 0.5;
   Force::UniformGravity(it.forces, it.matter, Vec3(0, 0, -9.81));
   it.poses.push_back(Transform(Vec3(0.05, 0, 0)));
   it.bodies.push_back(MobilizedBody::Free(it.body(-1), it.poses[0], Mechanism::rigid(0.2, Vec3(1e-6, 1e-5, 1e-5)), Transform()));
   auto joint = std::make_unique<Loose>();
   const Real radius = 0.01, compliance = (1 - 0.09)/207e9;
   joint->clearance = 0.5e-3;
   joint->stiffness = 4/(6*compliance)*std::sqrt(radius*(radius - joint->clearance)/joint->clearance);
   joint->hysteresis = 0.75*(1 - 0.81);
   joint->bearing = it.body(-1);
   joint->journal = it.body(0);
   joint->at_bearing = Vec3(0);
   joint->at_journal = Vec3(-0.05, 0, 0);
   Force::Custom(it.forces, new LooseForce(*joint));
   it.system.addEventHandler(new Onset(*joint));
   it.loose.push_back(std::move(joint));
}

}  // namespace

int main(int argc, char** argv) {
   if (argc != 4) return 2;
   try {
      Mechanism it;
      const std::string scene = argv[1];
      if (scene == "bricard") bricard(it);
      else if (scene == "governor") governor(it);
      else if (scene == "spatial_slider_crank") slider_crank(it);
      else if (scene == "ball_pendulum") ball_pendulum(it);
      else throw std::runtime_error("unknown scene " + scene);
      State state = it.system.realizeTopology();
      it.system.realizeModel(state);
      for (const auto& [k, speed] : it.start) it.bodies[static_cast<size_t>(k)].setOneU(state, 0, speed);
      const State last = solved(it.system, state, it.end, argv[2], std::stod(argv[3]), it.loose);
      for (const auto& body : it.bodies) {
         const Vec3 at = body.findStationLocationInGround(last, Vec3(0));
         std::printf("centre %.17g %.17g %.17g\n", at[0], at[1], at[2]);
      }
   } catch (const std::exception& e) {
      std::fprintf(stderr, "%s\n", e.what());
      return 1;
   }
   return 0;
}
