// Straight beam 6 x 0.2 x 0.1 of six elements whose sides lean by 45 degrees, this way and that.
h = 0.2; t = 0.1;
For i In {0 : 6}
  lean = (i == 0 || i == 6) ? 0 : ((i % 2 == 1) ? h / 2 : -h / 2);
  Point(i + 1) = {i + lean, 0, 0};
  Point(i + 11) = {i - lean, h, 0};
  Line(i + 31) = {i + 1, i + 11};
EndFor
For i In {1 : 6}
  Line(i) = {i, i + 1};
  Line(i + 10) = {i + 10, i + 11};
  Curve Loop(i) = {i, i + 31, -(i + 10), -(i + 30)};
  Plane Surface(i) = {i};
  Transfinite Curve{i, i + 10, i + 30, i + 31} = 2;
  Transfinite Surface{i};
  Recombine Surface{i};
EndFor
volumes[] = {};
For i In {1 : 6}
  out[] = Extrude{0, 0, t}{ Surface{i}; Layers{1}; Recombine; };
  volumes[] += out[1];
  If (i == 1)
    root = out[5];
  EndIf
  If (i == 6)
    tip = out[3];
  EndIf
EndFor
Physical Volume("beam") = volumes[];
Physical Surface("root") = {root};
Physical Surface("tip") = {tip};
