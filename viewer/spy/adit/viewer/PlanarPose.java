// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
package adit.viewer;

import java.awt.geom.AffineTransform;

/** A rigid transformation of the plane, T_a_b: x and y in metres, theta in radians. */
final class PlanarPose {
    static final PlanarPose IDENTITY = new PlanarPose(0, 0, 0);

    final double x;
    final double y;
    final double theta;

    PlanarPose(double x, double y, double theta) {
        this.x = x;
        this.y = y;
        this.theta = theta;
    }

    static PlanarPose of(double[] pose) {
        return new PlanarPose(pose[0], pose[1], pose[2]);
    }

    /** T_a_c, of T_a_b and T_b_c. */
    PlanarPose times(PlanarPose other) {
        double[] origin = transform(other.x, other.y);
        return new PlanarPose(origin[0], origin[1], theta + other.theta);
    }

    /** The coordinates in a of a point with these coordinates in b. */
    double[] transform(double px, double py) {
        double c = Math.cos(theta);
        double s = Math.sin(theta);
        return new double[] {x + c * px - s * py, y + s * px + c * py};
    }

    AffineTransform affine() {
        AffineTransform transform = AffineTransform.getTranslateInstance(x, y);
        transform.rotate(theta);
        return transform;
    }
}
