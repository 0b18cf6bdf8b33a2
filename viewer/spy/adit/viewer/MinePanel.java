// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
package adit.viewer;

import adit.cloud_line_t;
import adit.path_point_t;
import adit.pose_constraint_t;
import adit.terrain_t;
import java.awt.BasicStroke;
import java.awt.Color;
import java.awt.Dimension;
import java.awt.Graphics;
import java.awt.Graphics2D;
import java.awt.RenderingHints;
import java.awt.event.MouseAdapter;
import java.awt.event.MouseEvent;
import java.awt.event.MouseWheelEvent;
import java.awt.geom.AffineTransform;
import java.awt.geom.Line2D;
import java.awt.geom.Path2D;
import java.awt.geom.Point2D;
import java.util.EnumSet;
import java.util.Map;
import javax.swing.JPanel;

/**
 * Draws a scene in plan, x to the right and y upwards. The wheel zooms, dragging moves, a double
 * click fits everything again.
 */
final class MinePanel extends JPanel {
    /** What is drawn, from below to above. */
    enum Layer {
        TERRAIN("terrain"), LOCAL_MAPS("local maps"), SCAN("3D scan"), GRAPH("pose graph"),
        PATH("path"), ROBOT("robot");

        final String label;

        Layer(String label) {
            this.label = label;
        }
    }

    static final Color PAPER = new Color(0xe8e5df);
    static final Color WALL = new Color(0x1f242b);
    /** Beams that should have hit the ground had no return: water, or open air. */
    static final Color NO_RETURN = new Color(0x6fb7e8);
    static final Color UNKNOWN_GROUND = new Color(0xc9c5bc);
    static final Color EASY_GROUND = new Color(0x9fd8a8);
    static final Color HARD_GROUND = new Color(0xd9534a);
    static final Color SEQUENTIAL = new Color(0x6d747c);
    static final Color LOOP_CLOSURE = new Color(0x2fa32a);
    static final Color FORWARD = new Color(0x1f5fb4);
    static final Color REVERSE = new Color(0xe0218a);
    static final Color ROBOT = new Color(0xc8324a);
    /** Colours of the heights of a 3D scan, from 1 m below the robot to 2 m above it. */
    static final Color LOW = new Color(0x2f6fc1);
    static final Color HIGH = new Color(0xf07800);

    private static final double COEFFICIENT_HARD_MM = 300;
    private static final int MARGIN = 30;  // pixels

    private final MineScene scene;
    private final EnumSet<Layer> layers = EnumSet.allOf(Layer.class);
    private AffineTransform view;  // map to pixels; null: fit everything
    private Point2D dragged;

    /** The lock of the scene is the scene itself. */
    MinePanel(MineScene scene) {
        this.scene = scene;
        setPreferredSize(new Dimension(900, 700));
        MouseAdapter mouse = new MouseAdapter() {
            @Override
            public void mouseWheelMoved(MouseWheelEvent event) {
                zoom(event.getPoint(), Math.pow(1.2, -event.getPreciseWheelRotation()));
            }

            @Override
            public void mousePressed(MouseEvent event) {
                dragged = event.getPoint();
            }

            @Override
            public void mouseDragged(MouseEvent event) {
                move(event.getX() - dragged.getX(), event.getY() - dragged.getY());
                dragged = event.getPoint();
            }

            @Override
            public void mouseClicked(MouseEvent event) {
                if (event.getClickCount() == 2) view = null;
                repaint();
            }
        };
        addMouseListener(mouse);
        addMouseMotionListener(mouse);
        addMouseWheelListener(mouse);
    }

    void show(Layer layer, boolean shown) {
        if (shown) {
            layers.add(layer);
        } else {
            layers.remove(layer);
        }
        repaint();
    }

    /** From map [m] to pixels. */
    AffineTransform view() {
        synchronized (scene) {
            return view != null ? view : fitted(scene.bounds());
        }
    }

    private void zoom(Point2D at, double factor) {
        AffineTransform zoomed = AffineTransform.getTranslateInstance(at.getX(), at.getY());
        zoomed.scale(factor, factor);
        zoomed.translate(-at.getX(), -at.getY());
        zoomed.concatenate(view());
        view = zoomed;
        repaint();
    }

    private void move(double x, double y) {
        AffineTransform moved = AffineTransform.getTranslateInstance(x, y);
        moved.concatenate(view());
        view = moved;
        repaint();
    }

    private AffineTransform fitted(double[] box) {
        double[] shown = box != null ? box : new double[] {-10, -10, 10, 10};
        double width = Math.max(shown[2] - shown[0], 1.0);
        double height = Math.max(shown[3] - shown[1], 1.0);
        double scale = Math.max(Math.min((getWidth() - 2 * MARGIN) / width,
                (getHeight() - 2 * MARGIN) / height), 0.1);
        AffineTransform fit =
                AffineTransform.getTranslateInstance(getWidth() / 2.0, getHeight() / 2.0);
        fit.scale(scale, -scale);
        fit.translate(-(shown[0] + shown[2]) / 2, -(shown[1] + shown[3]) / 2);
        return fit;
    }

    @Override
    protected void paintComponent(Graphics graphics) {
        Graphics2D g = (Graphics2D) graphics.create();
        g.setColor(PAPER);
        g.fillRect(0, 0, getWidth(), getHeight());
        synchronized (scene) {
            AffineTransform toPixel = view();
            if (layers.contains(Layer.TERRAIN)) drawTerrain(g, toPixel);
            if (layers.contains(Layer.LOCAL_MAPS)) drawLocalMaps(g, toPixel);
            if (layers.contains(Layer.SCAN)) drawScan(g, toPixel);
            g.setRenderingHint(RenderingHints.KEY_ANTIALIASING, RenderingHints.VALUE_ANTIALIAS_ON);
            if (layers.contains(Layer.GRAPH)) drawGraph(g, toPixel);
            if (layers.contains(Layer.PATH)) drawPath(g, toPixel);
            if (layers.contains(Layer.ROBOT)) drawRobot(g, toPixel);
            drawScaleBar(g, toPixel);
        }
        g.dispose();
    }

    private void drawTerrain(Graphics2D g, AffineTransform toPixel) {
        MineScene.Terrain terrain = scene.terrain;
        if (terrain == null) return;
        AffineTransform transform = new AffineTransform(toPixel);
        transform.concatenate(scene.T_map_odom.times(terrain.T_odom_level).affine());
        double m = terrain.cellM;
        for (int row = 0; row < terrain.rows; ++row) {
            for (int column = 0; column < terrain.columns; ++column) {
                int cell = row * terrain.columns + column;
                byte ground = terrain.ground[cell];
                if (ground == terrain_t.GROUND_NEVER_OBSERVED
                        || ground == terrain_t.GROUND_OCCLUDED) {
                    continue;
                }
                short coefficient = terrain.coefficientMm[cell];
                boolean known = ground == terrain_t.GROUND_OBSERVED
                        && coefficient != terrain_t.UNKNOWN;
                g.setColor(known
                        ? blend(EASY_GROUND, HARD_GROUND, coefficient / COEFFICIENT_HARD_MM)
                        : ground == terrain_t.GROUND_NO_RETURN ? NO_RETURN : UNKNOWN_GROUND);
                double x = terrain.cornerX + column * m;
                double y = terrain.cornerY + row * m;
                Path2D square = new Path2D.Double();
                square.moveTo(x, y);
                square.lineTo(x + m, y);
                square.lineTo(x + m, y + m);
                square.lineTo(x, y + m);
                square.closePath();
                g.fill(transform.createTransformedShape(square));
            }
        }
    }

    private void drawLocalMaps(Graphics2D g, AffineTransform toPixel) {
        g.setColor(WALL);
        for (Map.Entry<Integer, MineScene.LocalMap> map : scene.localMaps.entrySet()) {
            PlanarPose pose = scene.poseOf(map.getKey());
            if (pose == null) continue;
            AffineTransform transform = new AffineTransform(toPixel);
            transform.concatenate(pose.affine());
            float[] pixels = map.getValue().points(scene.mounts).clone();
            transform.transform(pixels, 0, pixels, 0, pixels.length / 2);
            for (int i = 0; i < pixels.length; i += 2) dot(g, pixels[i], pixels[i + 1], 1);
        }
    }

    private void drawScan(Graphics2D g, AffineTransform toPixel) {
        AffineTransform transform = new AffineTransform(toPixel);
        transform.concatenate(scene.T_map_odom.times(scene.T_odom_cloud).affine());
        for (cloud_line_t line : scene.cloud) {
            for (float[] point : line.points) {
                Point2D pixel = transform.transform(new Point2D.Float(point[0], point[1]), null);
                g.setColor(blend(LOW, HIGH, (point[2] + 1.0) / 3.0));
                dot(g, pixel.getX(), pixel.getY(), 1);
            }
        }
    }

    private void drawGraph(Graphics2D g, AffineTransform toPixel) {
        g.setStroke(new BasicStroke(1.2f));
        for (pose_constraint_t constraint : scene.constraints) {
            PlanarPose from = scene.poseOf(constraint.from);
            PlanarPose to = scene.poseOf(constraint.to);
            if (from == null || to == null) continue;
            boolean loop = constraint.kind == pose_constraint_t.KIND_LOOP_CLOSURE;
            g.setColor(loop ? LOOP_CLOSURE : SEQUENTIAL);
            g.draw(toPixel.createTransformedShape(new Line2D.Double(from.x, from.y, to.x, to.y)));
        }
        g.setColor(SEQUENTIAL);
        for (PlanarPose pose : scene.poses) {
            if (pose == null) continue;
            Point2D pixel = toPixel.transform(new Point2D.Double(pose.x, pose.y), null);
            dot(g, pixel.getX(), pixel.getY(), 5);
        }
    }

    private void drawPath(Graphics2D g, AffineTransform toPixel) {
        if (scene.path == null) return;
        g.setStroke(new BasicStroke(3f, BasicStroke.CAP_ROUND, BasicStroke.JOIN_ROUND));
        path_point_t[] points = scene.path.points;
        for (int i = 1; i < points.length; ++i) {
            double[] from = inMap(points[i - 1].T_odom_body);
            double[] to = inMap(points[i].T_odom_body);
            g.setColor(points[i - 1].reverse != 0 ? REVERSE : FORWARD);
            g.draw(toPixel.createTransformedShape(
                    new Line2D.Double(from[0], from[1], to[0], to[1])));
        }
    }

    private void drawRobot(Graphics2D g, AffineTransform toPixel) {
        if (scene.T_odom_body == null) return;
        PlanarPose pose = scene.T_map_odom.times(scene.T_odom_body);
        Path2D arrow = new Path2D.Double();
        arrow.moveTo(1.0, 0.0);
        arrow.lineTo(-0.9, 0.6);
        arrow.lineTo(-0.5, 0.0);
        arrow.lineTo(-0.9, -0.6);
        arrow.closePath();
        AffineTransform transform = new AffineTransform(toPixel);
        transform.concatenate(pose.affine());
        double pixels = Math.sqrt(Math.abs(toPixel.getDeterminant()));
        double enlarged = Math.max(1.0, 9.0 / pixels);  // visible in a large mine
        transform.scale(enlarged, enlarged);
        g.setColor(ROBOT);
        g.fill(transform.createTransformedShape(arrow));
    }

    private void drawScaleBar(Graphics2D g, AffineTransform toPixel) {
        double pixels = Math.sqrt(Math.abs(toPixel.getDeterminant()));
        double decade = Math.pow(10, Math.floor(Math.log10(150 / pixels)));
        double metres = decade;
        for (double step : new double[] {2, 5}) {
            if (step * decade * pixels <= 150) metres = step * decade;
        }
        int y = getHeight() - 14;
        g.setColor(WALL);
        g.fillRect(12, y, (int) Math.round(metres * pixels), 4);
        String text = metres >= 1 ? String.format(java.util.Locale.ROOT, "%.0f m", metres)
                : String.format(java.util.Locale.ROOT, "%.2g m", metres);
        g.drawString(text, 12, y - 5);
    }

    private double[] inMap(double[] T_odom_body) {
        return scene.T_map_odom.transform(T_odom_body[0], T_odom_body[1]);
    }

    private static void dot(Graphics2D g, double x, double y, int size) {
        g.fillRect((int) Math.floor(x - (size - 1) / 2.0), (int) Math.floor(y - (size - 1) / 2.0),
                size, size);
    }

    private static Color blend(Color from, Color to, double share) {
        double s = Math.max(0.0, Math.min(1.0, share));
        return new Color((int) Math.round(from.getRed() + s * (to.getRed() - from.getRed())),
                (int) Math.round(from.getGreen() + s * (to.getGreen() - from.getGreen())),
                (int) Math.round(from.getBlue() + s * (to.getBlue() - from.getBlue())));
    }
}
