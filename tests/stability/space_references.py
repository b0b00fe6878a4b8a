"""Answers of the hard cases of space, each found without gudgeon: closed forms, or the motion integrated here in as many
coordinates as the mechanism has degrees of freedom."""

import functools

import numpy as np
from references import G, integrated
from scipy.integrate import solve_ivp

LONG = np.longdouble


def means(k2):
    """Arithmetic-geometric mean of 1 and sqrt(1 - k^2), given 1 - k^2: the sequences a, b, c."""
    a, b, c = [LONG(1)], [np.sqrt(LONG(k2))], [np.sqrt(1 - LONG(k2))]
    while c[-1] > 1e-19:
        a, b, c = a + [(a[-1] + b[-1])/2], b + [np.sqrt(a[-1]*b[-1])], c + [(a[-1] - b[-1])/2]
    return a, b, c


def jacobi(u, k2):
    """sn, cn, dn of long numbers by Landen's transformation, given 1 - k^2."""
    a, _, c = means(k2)
    phi = 2**(len(a) - 1)*a[-1]*u
    for n in range(len(a) - 1, 0, -1):
        phi = (phi + np.arcsin(c[n]/a[n]*np.sin(phi)))/2
    return np.sin(phi), np.cos(phi), np.sqrt(k2 + (1 - k2)*np.cos(phi)**2)


def first_kind(phi, k2):
    """Elliptic integral of the first kind up to phi in (0, pi/2), given 1 - k^2."""
    a, b, _ = means(k2)
    for n in range(len(a) - 1):
        phi = phi + np.arctan(b[n]/a[n]*np.tan(phi)) + LONG(np.pi)*np.floor(phi/LONG(np.pi) + LONG(0.5))
    return phi/(2**(len(a) - 1)*a[-1])


def tumbling_spin(times):
    """Spin of tumbling_body.deck along its own axes (instants, 3). It passes close to a steady turn about the middle axis, so
    everything is written in the small differences of the constants."""
    a, b, c = LONG(1), LONG(2), LONG(3)       # moments [kg.m^2]
    x, y, z = LONG(0.1), LONG(15), LONG(0.1)  # spin at the start [rad/s]
    beyond = a*(a - b)*x*x + c*(c - b)*z*z    # H^2 - 2 T b
    about = b*(b - a)*y*y + c*(c - a)*z*z     # H^2 - 2 T a
    below = a*(c - a)*x*x + b*(c - b)*y*y     # 2 T c - H^2
    k2 = (c - a)*beyond/((c - b)*about)       # 1 - k^2
    top = np.sqrt([below/(a*(c - a)), below/(b*(c - b)), about/(c*(c - a))])
    start = first_kind(np.arctan2(y/top[1], x/top[0]), k2)
    sn, cn, dn = jacobi(start + np.sqrt((c - b)*about/(a*b*c))*np.asarray(times, LONG), k2)
    return np.column_stack([top[0]*cn, top[1]*sn, top[2]*dn]).astype(float)


def top_angles(times, spin):
    """Heavy top of heavy_top.deck, released with a spin: angle from the upward vertical and azimuth (instants, 2)."""
    across, along, weight, start = 0.3, 0.05, G*0.5, np.pi/6
    vertical = along*spin*np.cos(start)

    def rates(_, y):
        theta, _, slope = y
        turn = (vertical - along*spin*np.cos(theta))/(across*np.sin(theta)**2)
        return (slope, turn, (across*turn**2*np.cos(theta) - along*spin*turn + weight)*np.sin(theta)/across)

    return integrated(rates, (start, 0.0, 0.0), times)[:, :2]


@functools.lru_cache(maxsize=None)
def governor(end, n):
    """IFToMM A05 at n equal steps up to the end: turn of the shaft, angle of a rod below the horizontal, height of the slider,
    and their rates (6, n + 1). The two rods move alike."""
    reach, mass, rod = 0.97169811320754717, 5.3, (5e-6, 0.0957579)  # of a rod with its ball; moments along it, across it
    shaft, slider = 5e-6, 0.005

    def rates(_, y):
        _, beta, z, w, u, v = y
        c, s = np.cos(beta), np.sin(beta)
        out = 0.05 + reach*c
        about = shaft + slider + 2*(mass*out**2 + rod[0]*s*s + rod[1]*c*c)
        by_angle = 4*((rod[0] - rod[1])*s*c - mass*out*reach*s)
        across, down = 0.5*c, 1 - 0.5*s - z                         # from the eye of the slider to the middle of the rod
        length = np.hypot(across, down)
        by_beta, by_z = -0.5*(across*s + down*c)/length, -down/length
        force = 8e5*(length - 0.5) + 4e4*(by_beta*u + by_z*v)
        return [w, u, v, -by_angle*u*w/about, (by_angle*w*w/2 + 2*mass*G*reach*c - 2*force*by_beta)/(2*(mass*reach**2 + rod[1])),
                -G - 2*force*by_z/3]

    return solve_ivp(rates, (0, end), [0, np.pi/6, 0.5, 2*np.pi, 0, 0], method="LSODA", rtol=1e-11, atol=1e-12,
                     t_eval=np.linspace(0, end, n + 1)).y


class SpatialSliderCrank:
    """inputs/hard/spatial_slider_crank.deck in one coordinate, the crank's angle.

    Inertia and potential of all bodies over one turn as Fourier series, from positions that are known functions of the angle.
    """

    RADIUS, LENGTH, HEIGHT = 0.1, 0.4, 0.15   # crank, coupler, axis of the crank over the slider's line [m]
    CRANK, ROD, SLIDER = (0.2, 5e-4), (0.3, 2e-5, 4e-3), 0.5  # masses [kg] and moments [kg.m^2]

    def __init__(self, n=512):
        angle = 2*np.pi*np.arange(n)/n
        pin = np.stack([0*angle, self.RADIUS*np.cos(angle), self.HEIGHT + self.RADIUS*np.sin(angle)])
        slider = np.stack([np.sqrt(self.LENGTH**2 - pin[1]**2 - pin[2]**2), 0*angle, 0*angle])
        axis = (slider - pin)/self.LENGTH
        arm = np.cross([0, 0, 1.0], axis, axis=0)
        arm /= np.linalg.norm(arm, axis=0)
        frame = np.stack([axis, arm, np.cross(axis, arm, axis=0)])
        slope = np.stack([self.derived(row) for row in frame])
        turn = np.stack([np.sum(slope[1]*frame[2], axis=0), np.sum(slope[2]*frame[0], axis=0), np.sum(slope[0]*frame[1], axis=0)])
        middle = (slider + pin)/2
        inertia = (self.CRANK[1] + self.ROD[0]*np.sum(self.derived(middle)**2, axis=0) + self.ROD[1]*turn[0]**2
                   + self.ROD[2]*(turn[1]**2 + turn[2]**2) + self.SLIDER*self.derived(slider)[0]**2)
        height = self.ROD[0]*middle[2] + self.CRANK[0]*self.HEIGHT
        self.inertia, self.change, self.load = (self.series(v) for v in (inertia, self.derived(inertia), G*self.derived(height)))
        self.slider = self.series(slider[0])

    @staticmethod
    def derived(values):
        """Derivative of a periodic function by its samples."""
        n = values.shape[-1]
        return np.fft.irfft(1j*np.arange(n//2 + 1)*np.fft.rfft(values), n)

    @staticmethod
    def series(values):
        """Its trigonometric interpolant."""
        n = len(values)
        of = np.fft.rfft(values)/n
        kept = np.nonzero(np.abs(of) > 1e-17*np.abs(of).max())[0]
        weight = np.where(kept == 0, 1.0, 2.0)*of[kept]
        return lambda x: np.real(np.exp(1j*np.multiply.outer(x, kept)) @ weight)

    def motion(self, speed, times):
        """Angle and speed of the crank at the times (instants, 2)."""
        def rates(_, y):
            return y[1], -(0.5*self.change(y[0])*y[1]**2 + self.load(y[0]))/self.inertia(y[0])

        return integrated(rates, (0.0, speed), times)
