// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
package adit.viewer;

import adit.path_point_t;
import java.awt.Color;
import java.awt.Graphics2D;
import java.awt.geom.AffineTransform;
import java.awt.geom.Line2D;
import java.awt.geom.Point2D;
import java.awt.image.BufferedImage;
import java.io.EOFException;
import java.io.File;
import java.util.ArrayList;
import java.util.List;
import javax.imageio.ImageIO;
import lcm.lcm.LCMDataInputStream;
import lcm.logging.Log;

/**
 * MinePanelTest LOG [PICTURE.png]: draws the log of the synthetic mission off-screen, layer by
 * layer, and compares the pixels with the tunnel along x that is 4 m wide, in which the robot drove.
 */
public final class MinePanelTest {
    private static final double HALF_WIDTH_M = 2.0;
    private static final int WIDTH = 900;
    private static final int HEIGHT = 500;
    private static final int SCALE_BAR = 40;  // pixels at the lower edge
    private static int failures;

    private MinePanelTest() {}

    private static void expect(boolean condition, String what) {
        System.out.println((condition ? "ok " : "FAILED ") + what);
        if (!condition) ++failures;
    }

    private static MineScene sceneOf(String path) throws Exception {
        MineScene scene = new MineScene();
        SceneSubscriber subscriber = new SceneSubscriber(scene, () -> { });
        Log log = new Log(path, "r");
        try {
            while (true) {
                Log.Event event = log.readNext();
                subscriber.messageReceived(null, event.channel,
                        new LCMDataInputStream(event.data, 0, event.data.length));
            }
        } catch (EOFException end) {
            return scene;
        }
    }

    private static BufferedImage draw(MinePanel panel, MinePanel.Layer... layers) {
        for (MinePanel.Layer layer : MinePanel.Layer.values()) panel.show(layer, false);
        for (MinePanel.Layer layer : layers) panel.show(layer, true);
        BufferedImage image = new BufferedImage(WIDTH, HEIGHT, BufferedImage.TYPE_INT_RGB);
        Graphics2D graphics = image.createGraphics();
        panel.paint(graphics);
        graphics.dispose();
        return image;
    }

    /** Places in map of the pixels of a colour, or of any but paper if it is null. */
    private static List<Point2D> places(MinePanel panel, BufferedImage image, Color colour)
            throws Exception {
        AffineTransform toMap = panel.view().createInverse();
        List<Point2D> places = new ArrayList<>();
        for (int y = 0; y < HEIGHT - SCALE_BAR; ++y) {
            for (int x = 0; x < WIDTH; ++x) {
                Color pixel = new Color(image.getRGB(x, y));
                boolean found = colour != null ? pixel.equals(colour)
                        : !pixel.equals(MinePanel.PAPER);
                if (found) places.add(toMap.transform(new Point2D.Double(x + 0.5, y + 0.5), null));
            }
        }
        return places;
    }

    private static double share(List<Point2D> places, java.util.function.Predicate<Point2D> test) {
        return places.isEmpty() ? 0.0
                : (double) places.stream().filter(test).count() / places.size();
    }

    private static double distanceToPath(MineScene scene, Point2D p) {
        double least = Double.MAX_VALUE;
        path_point_t[] points = scene.path.points;
        for (int i = 1; i < points.length; ++i) {
            double[] a = scene.T_map_odom.transform(points[i - 1].T_odom_body[0],
                    points[i - 1].T_odom_body[1]);
            double[] b = scene.T_map_odom.transform(points[i].T_odom_body[0],
                    points[i].T_odom_body[1]);
            least = Math.min(least, Line2D.ptSegDist(a[0], a[1], b[0], b[1], p.getX(), p.getY()));
        }
        return least;
    }

    public static void main(String[] arguments) throws Exception {
        MineScene scene = sceneOf(arguments[0]);
        MinePanel panel = new MinePanel(scene);
        panel.setSize(WIDTH, HEIGHT);
        double pixelM = 1.0 / Math.sqrt(Math.abs(panel.view().getDeterminant()));
        System.out.printf("a pixel is %.3f m%n", pixelM);

        List<Point2D> walls = places(panel, draw(panel, MinePanel.Layer.LOCAL_MAPS),
                MinePanel.WALL);
        expect(walls.size() > 300, "walls are drawn: " + walls.size() + " pixels");
        double atWall = share(walls,
                p -> Math.abs(Math.abs(p.getY()) - HALF_WIDTH_M) < 0.1 + pixelM);
        expect(atWall > 0.85, "walls are 2 m to either side: " + atWall);  // others: the ends

        List<Point2D> ground = places(panel, draw(panel, MinePanel.Layer.TERRAIN), null);
        expect(ground.size() > 300, "terrain is drawn: " + ground.size() + " pixels");
        double inside = share(ground, p -> Math.abs(p.getY()) < HALF_WIDTH_M + 0.4);
        expect(inside > 0.95, "terrain is between the walls: " + inside);

        List<Point2D> scan = places(panel, draw(panel, MinePanel.Layer.SCAN), null);
        expect(scan.size() > 100, "3D scan is drawn: " + scan.size() + " pixels");
        double scanInside = share(scan, p -> Math.abs(p.getY()) < HALF_WIDTH_M + 0.2);
        expect(scanInside > 0.95, "3D scan is between the walls: " + scanInside);

        List<Point2D> robot = places(panel, draw(panel, MinePanel.Layer.ROBOT), MinePanel.ROBOT);
        double[] body = scene.T_map_odom.transform(scene.T_odom_body.x, scene.T_odom_body.y);
        expect(!robot.isEmpty() && share(robot,
                p -> p.distance(body[0], body[1]) < 1.3) == 1.0, "robot is at its pose");

        BufferedImage graph = draw(panel, MinePanel.Layer.GRAPH);
        boolean nodes = scene.poses.length == 4;
        for (PlanarPose pose : scene.poses) {
            Point2D at = panel.view().transform(new Point2D.Double(pose.x, pose.y), null);
            int rgb = graph.getRGB((int) at.getX(), (int) at.getY());
            nodes &= new Color(rgb).equals(MinePanel.SEQUENTIAL);
        }
        expect(nodes, "each of the four local maps is a node of the graph");

        // The last path of the mission is none; the one before was found.
        expect(places(panel, draw(panel, MinePanel.Layer.PATH), null).isEmpty(),
                "a blocked path is not drawn");
        scene.add(foundPath(arguments[0]));
        List<Point2D> path = places(panel, draw(panel, MinePanel.Layer.PATH), MinePanel.FORWARD);
        expect(path.size() > 50, "path is drawn: " + path.size() + " pixels");
        double onPath = share(path, p -> distanceToPath(scene, p) < 3 * pixelM);
        expect(onPath == 1.0, "path is where it was planned: " + onPath);

        if (arguments.length > 1) {
            ImageIO.write(draw(panel, MinePanel.Layer.values()), "png", new File(arguments[1]));
        }
        System.exit(failures == 0 ? 0 : 1);
    }

    private static adit.planned_path_t foundPath(String file) throws Exception {
        Log log = new Log(file, "r");
        while (true) {
            Log.Event event = log.readNext();
            if (!event.channel.equals("PATH")) continue;
            adit.planned_path_t path = new adit.planned_path_t(event.data);
            if (path.n_points > 0) return path;
        }
    }
}
