# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# write_ros1_bags.py CARMEN_LOG FOLDER
# Writes the readings of a CARMEN log with rosbag of Debian's ROS 1 (python3-rosbag): none.bag, bz2.bag, lz4.bag, and clouds.bag, of a
# 3D lidar 0.7 m above base_link that measures the same walls at three heights. Exits with 77 if it is not installed.
import math
import sys

try:
    import genpy
    import rosbag
    from geometry_msgs.msg import TransformStamped
    from nav_msgs.msg import Odometry
    from sensor_msgs import point_cloud2
    from sensor_msgs.msg import LaserScan
    from std_msgs.msg import Header
    from tf2_msgs.msg import TFMessage
except ImportError as error:
    print(f"skipped: {error}, try: apt install python3-rosbag python3-nav-msgs python3-tf2-msgs", file=sys.stderr)
    sys.exit(77)


def stamp(text):
    seconds, _, fraction = text.partition(".")
    return genpy.Time(int(seconds), int((fraction + "000000000")[:9]))


def messages(path):
    """Topic, message and time of each reading, with the laser at the origin of base_link."""
    mount = TransformStamped()
    mount.header.frame_id, mount.child_frame_id = "base_link", "laser"
    mount.transform.rotation.w = 1.0
    for line in open(path, encoding="ascii"):
        fields = line.split()
        if not fields or fields[0] != "FLASER":
            continue
        beams = int(fields[1])
        x, y, theta = (float(value) for value in fields[beams + 5 : beams + 8])
        time = stamp(fields[beams + 8])
        if mount is not None:
            mount.header.stamp = time
            yield "/tf_static", TFMessage([mount]), time
            mount = None
        odometry = Odometry()
        odometry.header.stamp = time
        odometry.header.frame_id, odometry.child_frame_id = "odom", "base_link"
        odometry.pose.pose.position.x, odometry.pose.pose.position.y = x, y
        odometry.pose.pose.orientation.z = math.sin(0.5 * theta)
        odometry.pose.pose.orientation.w = math.cos(0.5 * theta)
        yield "/odom", odometry, time
        scan = LaserScan()
        scan.header.stamp = time
        scan.header.frame_id = "laser"
        scan.angle_min, scan.angle_max = -0.5 * math.pi, 0.5 * math.pi
        scan.angle_increment = math.pi / (beams - beams % 2)
        scan.range_min, scan.range_max = 0.1, 50.0
        scan.ranges = [float(value) for value in fields[2 : beams + 2]]
        yield "/scan", scan, time


def clouds(path):
    for topic, message, time in messages(path):
        if topic == "/tf_static":
            message.transforms[0].transform.translation.z = 0.7
        if topic != "/scan":
            yield topic, message, time
            continue
        points = []
        for i, distance in enumerate(message.ranges):
            angle = message.angle_min + i * message.angle_increment
            if distance < message.range_max:
                points += [(distance * math.cos(angle), distance * math.sin(angle), z) for z in (-0.5, 0.0, 0.5)]
        yield "/points", point_cloud2.create_cloud_xyz32(Header(0, time, "laser"), points), time


with rosbag.Bag(f"{sys.argv[2]}/clouds.bag", "w") as cloud_bag:
    for topic, message, time in clouds(sys.argv[1]):
        cloud_bag.write(topic, message, time)
for compression in ("none", "bz2", "lz4"):
    with rosbag.Bag(f"{sys.argv[2]}/{compression}.bag", "w", compression=compression, chunk_threshold=60_000) as bag:
        for topic, message, time in messages(sys.argv[1]):
            bag.write(topic, message, time)
