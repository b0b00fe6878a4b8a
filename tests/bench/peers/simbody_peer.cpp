// Solves a scene of scenes.py with Simbody: simbody_peer METHOD ACCURACY < scene
//
// METHOD: merson and feldberg (Runge-Kutta pairs), cpodes_adams, cpodes_bdf.
// Prints the processor time of the solution [s], steps, evaluations, the onsets [s] of a loose pin, and x, y of the centre of mass
// of each body at the end [m].
#include "simbody_loose.h"

#include <deque>
#include <iostream>
#include <sstream>

namespace {

struct Scene {
   MultibodySystem system;
   SimbodyMatterSubsystem matter{system};
   GeneralForceSubsystem forces{system};
   std::deque<MobilizedBody> bodies;
   std::vector<Vec3> centres;
   std::vector<Real> angles, rates;
   std::vector<std::unique_ptr<Loose>> loose;
   Real end = 1;

   MobilizedBody& body(int k) { return k < 0 ? static_cast<MobilizedBody&>(matter.Ground()) : bodies[static_cast<size_t>(k)]; }
};

void read(Scene& scene, std::istream& in) {
   for (std::string line; std::getline(in, line);) {
      std::istringstream words(line);
      std::string word;
      words >> word;
      if (word == "gravity") {
         Real x, y;
         words >> x >> y;
         if (x != 0 || y != 0) Force::UniformGravity(scene.forces, scene.matter, Vec3(x, y, 0));
      } else if (word == "end") {
         words >> scene.end;
      } else if (word == "pin" || word == "slide") {
         int parent;
         Real px, py, mass, inertia, cx, cy, angle, rate;
         words >> parent >> px >> py >> mass >> inertia >> cx >> cy >> angle >> rate;
         const Vec3 centre(cx, cy, 0);
         const Inertia about_centre(inertia, inertia, inertia);
         const Body::Rigid rigid(MassProperties(mass, centre, about_centre.shiftFromMassCenter(-centre, mass)));
         if (word == "pin")
            scene.bodies.push_back(MobilizedBody::Pin(scene.body(parent), Transform(Vec3(px, py, 0)), rigid, Transform()));
         else
            scene.bodies.push_back(MobilizedBody::Slider(scene.body(parent), Transform(Vec3(px, py, 0)), rigid, Transform()));
         scene.centres.push_back(centre);
         scene.angles.push_back(angle);
         scene.rates.push_back(rate);
      } else if (word == "join") {
         int i, j;
         Real ix, iy, jx, jy;
         words >> i >> ix >> iy >> j >> jx >> jy;
         // Two equations, as a pin in the plane has.
         Constraint::PointInPlane(scene.body(i), UnitVec3(1, 0, 0), ix, scene.body(j), Vec3(jx, jy, 0));
         Constraint::PointInPlane(scene.body(i), UnitVec3(0, 1, 0), iy, scene.body(j), Vec3(jx, jy, 0));
      } else if (word == "spring") {
         int i, j;
         Real ix, iy, jx, jy, stiffness, free;
         words >> i >> ix >> iy >> j >> jx >> jy >> stiffness >> free;
         Force::TwoPointLinearSpring(scene.forces, scene.body(i), Vec3(ix, iy, 0), scene.body(j), Vec3(jx, jy, 0), stiffness, free);
      } else if (word == "torque") {
         int i;
         Real torque;
         words >> i >> torque;
         Force::ConstantTorque(scene.forces, scene.body(i), Vec3(0, 0, torque));
      } else if (word == "drive") {
         int i;
         Real speed;
         words >> i >> speed;
         Motion::Steady(scene.bodies[i], speed);
      } else if (word == "loose") {
         int i, j;
         Real ix, iy, jx, jy;
         auto joint = std::make_unique<Loose>();
         words >> i >> ix >> iy >> j >> jx >> jy >> joint->clearance >> joint->stiffness >> joint->hysteresis;
         joint->bearing = scene.body(i);
         joint->journal = scene.body(j);
         joint->at_bearing = Vec3(ix, iy, 0);
         joint->at_journal = Vec3(jx, jy, 0);
         Force::Custom(scene.forces, new LooseForce(*joint));
         scene.system.addEventHandler(new Onset(*joint));
         scene.loose.push_back(std::move(joint));
      }
   }
}

}  // namespace

int main(int argc, char** argv) {
   if (argc != 3) return 2;
   try {
      Scene scene;
      read(scene, std::cin);
      State state = scene.system.realizeTopology();
      scene.system.realizeModel(state);
      for (size_t k = 0; k < scene.bodies.size(); k++) {
         scene.bodies[k].setOneQ(state, 0, scene.angles[k]);
         scene.bodies[k].setOneU(state, 0, scene.rates[k]);
      }
      const State last = solved(scene.system, state, scene.end, argv[1], std::stod(argv[2]), scene.loose);
      for (size_t k = 0; k < scene.bodies.size(); k++) {
         const Vec3 at = scene.bodies[k].findStationLocationInGround(last, scene.centres[k]);
         std::printf("centre %.17g %.17g\n", at[0], at[1]);
      }
   } catch (const std::exception& e) {
      std::fprintf(stderr, "%s\n", e.what());
      return 1;
   }
   return 0;
}
