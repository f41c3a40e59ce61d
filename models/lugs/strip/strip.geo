// Strip of width D = 100 mm with a hole of d = 50 mm, whose middle is D from the square end and 3 D from the
// section where it is held; 10 mm thick. In millimetres. Quarters of the hole are swept to a square, the rest is swept too.
r = 25; w = 50; e = 100; s = -300; t = 5; c = r * Sqrt(0.5);
Point(1) = {0, 0, 0};
Point(2) = {c, -c, 0}; Point(3) = {c, c, 0}; Point(4) = {-c, c, 0}; Point(5) = {-c, -c, 0};
Point(12) = {w, -w, 0}; Point(13) = {w, w, 0}; Point(14) = {-w, w, 0}; Point(15) = {-w, -w, 0};
Point(23) = {w, e, 0}; Point(24) = {-w, e, 0};
Point(22) = {w, s, 0}; Point(25) = {-w, s, 0};
For i In {2 : 5}
  j = (i == 5) ? 2 : i + 1;
  Circle(i) = {i, 1, j};
  Line(10 + i) = {10 + i, 10 + j};
  Line(20 + i) = {i, 10 + i};
EndFor
For i In {2 : 5}
  j = (i == 5) ? 2 : i + 1;
  Curve Loop(i) = {20 + i, 10 + i, -(20 + j), -i};
  Plane Surface(i) = {i};
EndFor
Line(31) = {13, 23}; Line(32) = {23, 24}; Line(33) = {24, 14};
Curve Loop(6) = {13, -33, -32, -31}; Plane Surface(6) = {6};
Line(34) = {12, 22}; Line(35) = {22, 25}; Line(36) = {25, 15};
Curve Loop(7) = {15, 34, 35, 36}; Plane Surface(7) = {7};
Transfinite Curve{2:5, 12:15, 32, 35} = 9;
Transfinite Curve{22:25} = 7 Using Progression 1.2;
Transfinite Curve{31, 33} = 5;
Transfinite Curve{34, 36} = 11;
Transfinite Surface{2:7};
Recombine Surface{2:7};
out[] = Extrude{0, 0, t}{ Surface{2:7}; Layers{1}; Recombine; };
eps = 1e-3;
Physical Volume("strip") = Volume In BoundingBox{-w-eps, s-eps, -eps, w+eps, e+eps, t+eps};
Physical Surface("hole") = Surface In BoundingBox{-r-eps, -r-eps, -eps, r+eps, r+eps, t+eps};
Physical Surface("held") = Surface In BoundingBox{-w-eps, s-eps, -eps, w+eps, s+eps, t+eps};
Physical Surface("middle") = Surface In BoundingBox{-w-eps, s-eps, -eps, w+eps, e+eps, eps};
