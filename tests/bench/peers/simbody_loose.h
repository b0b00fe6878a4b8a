// What the programs for Simbody share: a loose joint as a force and an event, and the integrators by name.
//
// Frictionless contact of Lankarani and Nikravesh, whose impact speed is taken at the located onset.
#pragma once
#include <Simbody.h>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

using namespace SimTK;

struct Loose {
   MobilizedBody bearing, journal;
   Vec3 at_bearing, at_journal;
   Real clearance, stiffness, hysteresis;
   Real impact_speed = 1;
   bool touches = false;
   std::vector<Real> onsets;

   // Gap (positive apart), its rate, and the normal from bearing to journal.
   void measure(const State& state, Real& penetration, Real& rate, Vec3& normal) const {
      const Vec3 e = journal.findStationLocationInGround(state, at_journal) - bearing.findStationLocationInGround(state, at_bearing);
      const Real length = e.norm();
      normal = length > 0 ? e/length : Vec3(1, 0, 0);
      penetration = length - clearance;
      const Vec3 v = journal.findStationVelocityInGround(state, at_journal) - bearing.findStationVelocityInGround(state, at_bearing);
      rate = dot(v, normal);
   }
};

class LooseForce : public Force::Custom::Implementation {
public:
   explicit LooseForce(Loose& joint) : joint(joint) {}
   void calcForce(const State& state, Vector_<SpatialVec>& body_forces, Vector_<Vec3>&, Vector&) const override {
      Real penetration, rate;
      Vec3 normal;
      joint.measure(state, penetration, rate, normal);
      if (!joint.touches || penetration <= 0) return;
      const Real force = joint.stiffness*std::pow(penetration, 1.5)*(1 + joint.hysteresis*rate/joint.impact_speed);
      joint.journal.applyForceToBodyPoint(state, joint.at_journal, -force*normal, body_forces);
      joint.bearing.applyForceToBodyPoint(state, joint.at_bearing, force*normal, body_forces);
   }
   Real calcPotentialEnergy(const State&) const override { return 0; }

private:
   Loose& joint;
};

class Onset : public TriggeredEventHandler {
public:
   explicit Onset(Loose& joint) : TriggeredEventHandler(Stage::Velocity), joint(joint) {}
   Real getValue(const State& state) const override {
      Real penetration, rate;
      Vec3 normal;
      joint.measure(state, penetration, rate, normal);
      return penetration;
   }
   void handleEvent(State& state, Real, bool&) const override {
      Real penetration, rate;
      Vec3 normal;
      joint.measure(state, penetration, rate, normal);
      joint.touches = rate > 0;
      if (joint.touches) {
         joint.impact_speed = rate;
         joint.onsets.push_back(state.getTime());
      }
   }

private:
   Loose& joint;
};

inline Integrator* integrator_of(const std::string& method, const System& system) {
   if (method == "merson") return new RungeKuttaMersonIntegrator(system);
   if (method == "feldberg") return new RungeKuttaFeldbergIntegrator(system);
   if (method == "cpodes_adams") return new CPodesIntegrator(system, CPodes::Adams, CPodes::Functional);
   if (method == "cpodes_bdf") return new CPodesIntegrator(system, CPodes::BDF, CPodes::Newton);
   throw std::runtime_error("unknown method " + method);
}

// Solve up to the end; prints processor time [s], steps, onsets [s]. The state at the end.
inline State solved(const System& system, const State& start, Real end, const std::string& method, Real accuracy,
                    const std::vector<std::unique_ptr<Loose>>& loose) {
   std::unique_ptr<Integrator> integrator(integrator_of(method, system));
   integrator->setAccuracy(accuracy);
   integrator->setConstraintTolerance(accuracy);
   integrator->setFinalTime(end);
   integrator->setReturnEveryInternalStep(false);
   TimeStepper stepper(system, *integrator);
   const std::clock_t begun = std::clock();
   stepper.initialize(start);
   stepper.stepTo(end);
   const double cpu = double(std::clock() - begun)/CLOCKS_PER_SEC;
   std::printf("cpu %.9g\nsteps %d\n", cpu, integrator->getNumStepsTaken());
   for (const auto& joint : loose)
      for (const Real onset : joint->onsets) std::printf("onset %.17g\n", onset);
   State last = integrator->getState();
   system.realize(last, Stage::Position);
   return last;
}
