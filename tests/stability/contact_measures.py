"""What is measured in the hard cases of contacts: closed forms of impacts, of rest and of bounces that die out."""

import re

import numpy as np
from references import G
from scipy.optimize import brentq


def modulus(young, poisson):
    """E/(2 (1 - nu^2)) of two equal materials: with it K = 4/3 modulus sqrt(R)."""
    return young/(2.0*(1.0 - poisson**2))


FLOOR_STIFFNESS = 4.0/3.0*modulus(2e9, 0.4)*np.sqrt(0.02)  # dropped_ball.deck: a ball on a plane [N/m^1.5]
HOLE_STIFFNESS = 4.0/3.0*modulus(2e9, 0.4)*np.sqrt(0.01*0.0098/0.0002)  # pin_at_rest.deck: a pin in a hole [N/m^1.5]
BALL_REST = (0.26*G/FLOOR_STIFFNESS)**(2.0/3.0)  # depth of the ball at rest [m]
PIN_REST = (2.0*G/HOLE_STIFFNESS)**(2.0/3.0)  # depth of the pin at rest [m]


def energy_per_bounce(run):
    """Greatest relative change of the energy in a bounce; both speeds are at the height of first touch."""
    contacts = run.contacts[np.isfinite(run.contacts["release_speed"])]
    assert len(contacts) > 1, "no bounces"
    return float(np.max(np.abs((contacts["release_speed"]/contacts["impact_speed"])**2 - 1.0)))


def energy_of_10000_bounces(run):
    """Relative change of the energy from the first impact to the release of the ten thousandth."""
    contacts = run.contacts
    assert len(contacts) >= 10000, f"only {len(contacts)} bounces"
    return float(abs((contacts["release_speed"][9999]/contacts["impact_speed"][0])**2 - 1.0))


def delivered(restitution, pin_mass=1.0, ring_mass=1.0, speed=1.0):
    """Two free bodies: greatest error of the ratio of the speeds by the restitution, and of the momentum by that of the start."""
    def measure(run):
        contacts = run.contacts[np.isfinite(run.contacts["release_speed"])]
        assert len(contacts) > 0, "no impact"
        ratio = contacts["release_speed"][0]/contacts["impact_speed"][0]
        momentum = sum(mass*run.item("bodies/velocity", name)[:, 0] for name, mass in (("pin", pin_mass), ("ring", ring_mass)))
        return float(max(abs(ratio/restitution - 1.0), np.max(np.abs(momentum/(pin_mass*speed) - 1.0))))

    return measure


def at_rest(depth):
    """Error of the depth over the last hundredth of the run, of the only contact, relative to the depth of rest."""
    def measure(run):
        last = max(len(run.time)//100, 2)
        return float(np.max(np.abs(run.read("clearances/contacts/penetration")[-last:, 0]/depth - 1.0)))

    return measure


def zeno_times(restitution):
    """Onsets of bounces with the same restitution: error of t_k = t_1 + sum (2 v_j/g + T_j), the contacts T_j in the table taken
    from it, over the time of all bounces. Only impacts whose weight is small beside the force: v^2 > 30 g delta_rest."""
    def measure(run):
        contacts = run.contacts
        speed = contacts["impact_speed"][0]*restitution**np.arange(len(contacts))
        n = int(np.sum(speed**2 > 1e3*G*BALL_REST))
        assert n >= 4, f"only {n} free bounces"
        flights = 2.0*restitution*speed[:n - 1]/G
        exact = contacts["time"][0] + np.concatenate([[0.0], np.cumsum(flights + contacts["duration"][:n - 1])])
        whole = 2.0*speed[0]/G*restitution/(1.0 - restitution)
        return float(np.max(np.abs(contacts["time"][:n] - exact))/whole)

    return measure


def overlap_told(joint, depth):
    """The message of a start that overlaps: error of its depth, relative; infinite if it does not name the joint."""
    def measure(message):
        found = re.search(rf"initial overlap: joint '{joint}'.*?([-+0-9.eE]+) (um|mm|m)\b", message)
        if not found:
            return np.inf
        return abs(float(found.group(1))*{"um": 1e-6, "mm": 1e-3, "m": 1.0}[found.group(2)]/depth - 1.0)

    return measure


def wedge_angle(run):
    """The wedged slider: error of its angle at the end, relative to that beyond first touch."""
    length, height, gap, stiffness, moment = 0.05, 0.03, 0.5e-3, 1e6, 20.0

    def depth(angle):
        return 0.5*length*np.sin(angle) + 0.5*height*np.cos(angle) - 0.5*height - gap

    touch = brentq(depth, 0.0, 0.5)
    rest = brentq(lambda a: stiffness*depth(a)*(length*np.cos(a) - height*np.sin(a)) - moment, touch, 0.5, xtol=1e-16)
    touching = run.read("clearances/contacts/state")[-1] > 0
    assert touching.sum() == 2, f"{touching.sum()} corners touch"
    return float(abs(run.item("bodies/angle", "slider")[-1] - rest)/(rest - touch))


def distance_from_ideal(run):
    """The slider-crank with a tiny clearance: distance of the slider from its place without clearance, by the clearance."""
    crank = run.time*5000*2.0*np.pi/60
    ideal = 0.05*np.cos(crank) + np.sqrt(0.12**2 - (0.05*np.sin(crank))**2)
    return float(np.max(np.abs(run.item("bodies/position", "slider")[:, 0] - ideal))/1e-6)


def ledger(run):
    """Residual of the energy ledger, relative to the largest energy."""
    return run.summary["energy_residual_max"]/run.summary["energy_max"]


def grazed(overlap):
    """The ball that grazes a ceiling: error of its impact speed sqrt(2 g overlap), relative; infinite if there is a contact too
    many or too few."""
    def measure(run):
        if len(run.contacts) != (overlap > 0):
            return np.inf
        return float(abs(run.contacts["impact_speed"][0]/np.sqrt(20.0*overlap) - 1.0)) if overlap > 0 else 0.0

    return measure


def both_at_once(run):
    """The bar on two springs: errors of both durations pi/w and peaks m v w/2, their onset and release, and the turning, relative."""
    mass, speed, omega = 3.0, 2.0, np.sqrt(2.0*1e7/3.0)
    assert len(run.contacts) == 2, "not two contacts"
    errors = [np.abs(run.contacts[name]/exact - 1.0).max() for name, exact in (
        ("time", 1e-3/speed), ("duration", np.pi/omega), ("peak_force", 0.5*mass*speed*omega), ("release_speed", speed))]
    turned = np.max(np.abs(run.item("bodies/angular_velocity", "bar")))*0.3/speed
    return float(max(*errors, turned, np.ptp(run.contacts["time"]), np.ptp(run.contacts["duration"])))
