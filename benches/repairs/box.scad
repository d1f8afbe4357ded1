// A box with a lid beside it, and dividers in the box: one divider sticks out of its wall.
// keep: collisions = false
wall = 2;
inner = [80, 50, 30];
gap = 1;         // between the box and its lid

difference() {
    cube([inner[0] + 4, inner[1] + 4, inner[2] + 2]);
    translate([wall, wall, wall]) cube(inner);
}
translate([0, inner[1] + 3 + gap, 0]) cube([84, 54, 3]);
translate([30, 2.5, 2.1]) cube([1.5, 49, 25]);
translate([55, 4.5, 2.1]) cube([1.5, 49, 25]);
