// Cook's membrane: corners (0, 0), (48, 44), (48, 60), (0, 44); half of its thickness of 1.
Point(1) = {0, 0, 0};
Point(2) = {48, 44, 0};
Point(3) = {48, 60, 0};
Point(4) = {0, 44, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{1, 2, 3, 4} = 17;
Transfinite Surface{1};
Recombine Surface{1};
out[] = Extrude{0, 0, 0.5}{ Surface{1}; Layers{1}; Recombine; };
Physical Volume("membrane") = {out[1]};
Physical Surface("middle") = {1};
Physical Surface("tip") = {out[3]};
Physical Surface("root") = {out[5]};
