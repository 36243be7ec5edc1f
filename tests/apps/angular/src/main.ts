import { Component, CUSTOM_ELEMENTS_SCHEMA } from "@angular/core";
import { bootstrapApplication } from "@angular/platform-browser";
import "turnleaf";

@Component({
  selector: "app-root",
  schemas: [CUSTOM_ELEMENTS_SCHEMA],
  template: `
    <turnleaf-book
      src="/book.pdf"
      [page]="page"
      (pagechange)="page = $event.detail.to"
      style="width: 264px; height: 192px"
    ></turnleaf-book>
    <output>{{ page }}</output>
  `,
})
class App {
  page = 18;
}

bootstrapApplication(App);
