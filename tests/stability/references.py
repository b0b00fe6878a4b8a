"""Answers of the hard cases, each found without gudgeon: closed forms, published tables, or the motion integrated here in as many
coordinates as the mechanism has degrees of freedom (DOP853 or Radau at tolerances near round-off)."""

import functools

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import ellipj, ellipk

G = 9.81  # gravity of the decks [m/s^2]

# Andrews' squeezer at 0.03 s: beta, Theta, gamma, Phi, delta, Omega, epsilon [rad]. F. Mazzia and C. Magherini, Test Set for
# Initial Value Problem Solvers; the printed digits are good to about 2e-9.
SQUEEZER_ANGLES = (15.81077119629904, -15.75637105984298, 0.04082224013073101, -0.5347301163226948, 0.5244099658805304,
                   0.5347301163226948, 1.048080741042263)

# The four-bar of inputs/four_bar.deck: time [s], crank (turns counted), coupler and rocker angle [rad], by an independent
# integration in one coordinate with more than 14 digits.
FOUR_BAR_ANGLES = (
    (0.1, 33.864238646663266, 0.7062972235752102, 1.822244212805262),
    (0.5, 169.743671736357316, 1.136992402078535, 1.273493392882675),
    (1.0, 339.544966633900664, 0.7502615906501783, 0.9389960706480572),
    (2.0, 680.173166736159744, 0.4876109076098719, 1.318863117044833),
    (5.0, 1702.14343238568525, 2.31923340852756, 2.674244426800165),
)


def swing(t, omega, start):
    """Angle of a pendulum from the downward vertical, released at rest from `start`: angle'' = -omega^2 sin(angle)."""
    k = np.sin(0.5*start)
    sn, cn, dn, _ = ellipj(omega*np.asarray(t), k*k)
    return 2.0*np.arcsin(k*cn/dn)


def swing_period(omega, start):
    """Period of that pendulum [s]."""
    return 4.0*ellipk(np.sin(0.5*start)**2)/omega


def integrated(rates, start, times, tolerance=1e-13, method="DOP853"):
    """States at the times, one row each, from a start at t = 0."""
    times = np.atleast_1d(np.asarray(times, float))
    solution = solve_ivp(rates, (0.0, times[-1]), start, method=method, t_eval=times, rtol=tolerance, atol=tolerance)
    if not solution.success:
        raise RuntimeError(solution.message)
    return solution.y.T


@functools.lru_cache(maxsize=None)
def four_bars_angle(n, end):
    """IFToMM A02: theta from the upward vertical at `end` with n four-bars that stay parallelograms."""
    factor = G*((n + 1)/2 + n)/((n + 1)/3 + n)
    return integrated(lambda t, y: (y[1], factor*np.sin(y[0])), (0.0, 1.0), end)[-1, 0]


class FourBar:
    """A planar four-bar in one coordinate, the crank's angle; ground pivots at (0, 0) and (base, 0), centres of mass at
    mid-length."""

    def __init__(self, base, lengths, masses, inertias, gravity=0.0, branch=1):
        self.base, self.lengths, self.masses, self.inertias = base, lengths, masses, inertias
        self.gravity, self.branch = gravity, branch

    def angles(self, crank):
        """Coupler and rocker angle; the coupler-rocker pin lies left (branch 1) or right of the way to the rocker's pivot."""
        a, b, c = self.lengths
        ax, ay = a*np.cos(crank), a*np.sin(crank)
        dx, dy = self.base - ax, -ay
        d = np.hypot(dx, dy)
        turn = np.arccos((b*b + d*d - c*c)/(2.0*b*d))
        coupler = np.arctan2(dy, dx) + self.branch*turn
        rocker = np.arctan2(ay + b*np.sin(coupler), ax + b*np.cos(coupler) - self.base)
        return coupler, rocker

    def ratios(self, crank):
        """Angular velocities of crank, coupler, rocker by that of the crank."""
        a, b, c = self.lengths
        coupler, rocker = self.angles(crank)
        over = np.sin(rocker - coupler)
        return np.array([1.0, a*np.sin(crank - rocker)/(b*over), a*np.sin(crank - coupler)/(c*over)])

    def ratio_slopes(self, crank):
        """Their derivatives by the crank's angle: the second derivative of the closed loop."""
        a, b, c = self.lengths
        coupler, rocker = self.angles(crank)
        _, k3, k4 = self.ratios(crank)
        right = np.array([a*np.cos(crank) + b*np.cos(coupler)*k3**2 - c*np.cos(rocker)*k4**2,
                          a*np.sin(crank) + b*np.sin(coupler)*k3**2 - c*np.sin(rocker)*k4**2])
        matrix = np.array([[-b*np.sin(coupler), c*np.sin(rocker)], [b*np.cos(coupler), -c*np.cos(rocker)]])
        return np.concatenate(([0.0], np.linalg.solve(matrix, right)))

    def inertia(self, crank):
        """Reduced inertia I with T = I omega^2/2, its slope, and the slope of the potential energy."""
        a, b, c = self.lengths
        coupler, rocker = self.angles(crank)
        k, slope = self.ratios(crank), self.ratio_slopes(crank)
        m, j = self.masses, self.inertias
        own = np.array([j[0] + m[0]*a*a/4, j[1] + m[1]*b*b/4, j[2] + m[2]*c*c/4])
        cross = m[1]*a*b*np.cos(crank - coupler)
        total = np.sum(own*k**2) + m[1]*a*a + cross*k[1]
        change = 2.0*np.sum(own*k*slope) + cross*slope[1] - m[1]*a*b*np.sin(crank - coupler)*(1.0 - k[1])*k[1]
        height = (m[0]*a/2 + m[1]*a)*np.cos(crank) + m[1]*b/2*np.cos(coupler)*k[1] + m[2]*c/2*np.cos(rocker)*k[2]
        return total, change, self.gravity*height

    def motion(self, crank, omega, times):
        """Crank angle and speed at the times."""
        def rates(t, y):
            inertia, change, load = self.inertia(y[0])
            return y[1], -(0.5*change*y[1]**2 + load)/inertia

        return integrated(rates, (crank, omega), times)


def spring_pendulum(mass, stiffness, damping, free_length, length, times):
    """A point mass on a spring-damper that turns about the origin, from rest at (length, 0): x and y at the times."""
    def rates(t, y):
        r, phi, r_rate, phi_rate = y  # phi from the downward vertical
        force = stiffness*(r - free_length) + damping*r_rate
        return (r_rate, phi_rate, r*phi_rate**2 + G*np.cos(phi) - force/mass,
                (-G*np.sin(phi) - 2.0*r_rate*phi_rate)/r)

    y = integrated(rates, (length, 0.5*np.pi, 0.0, 0.0), times)
    return y[:, 0]*np.sin(y[:, 1]), -y[:, 0]*np.cos(y[:, 1])
